// SPDX-License-Identifier: BSD-3-Clause
// `posevote experiment ablation` on a small set.
#include <catch2/catch.hpp>

#include "tests/support/command.hpp"

namespace posevote::ablation_test {

using namespace posevote::test;

TEST_CASE("experiment ablation says what terms bring, of segmentation and training", "[ablation]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write(
      "spec.yaml",
      "models: [{shape: kettle, size: 0.2}]\n"
      "scenes: [{count: 3, ground: unseen, sensor: rgbd, objects: [1], clutter: 1}]\n");
  const std::string set = (folder / "kettles").string();
  REQUIRE(run_posevote(folder, "simulate " + spec + " --out " + set).status == 0);
  const CommandResult result = run_posevote(
      folder,
      "experiment ablation --every 2 --terms promising hopeless min_score find_symmetries.most"
      " --sets uwa=" +
          set + " --out " + (folder / "out").string());
  INFO(result.output);
  REQUIRE(result.status == 0);
  CHECK(result.output.find("image 2 of 2, 12 variations") != std::string::npos);
  CHECK(result.output.find("| all | as they are | | 2 of 2 | 0 |") != std::string::npos);
  CHECK(result.output.find("| find_symmetries.most | off | 0 | = | = |") != std::string::npos);
  const std::string csv = read_text(folder / "out/ablation.csv");
  CHECK(csv.find("\nkettles,segment_objects.promising,off,0,2,2,0,") != std::string::npos);
  CHECK(csv.find("\nkettles,segment_objects.min_score,off,0,2,2,") != std::string::npos);
  CHECK(read_text(folder / "out/ablation.md").find("kettles: found") != std::string::npos);
}

TEST_CASE("experiment ablation refuses sets and terms that there are not", "[ablation]") {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "out").string();
  const CommandResult set = run_posevote(folder, "experiment ablation --sets kitchen" + out);
  CHECK(set.status == 2);
  CHECK(set.output.find("--sets kitchen") != std::string::npos);
  const CommandResult term =
      run_posevote(folder, "experiment ablation --sets uwa=nowhere --terms outline_wait" + out);
  CHECK(term.status == 2);
  CHECK(term.output.find("--terms outline_wait") != std::string::npos);
  const CommandResult folder_missing =
      run_posevote(folder, "experiment ablation --sets uwa=nowhere --terms outline_weight" + out);
  CHECK(folder_missing.status == 2);
  CHECK(folder_missing.output.find("nowhere") != std::string::npos);
}

}  // namespace posevote::ablation_test
