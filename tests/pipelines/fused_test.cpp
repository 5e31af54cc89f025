// SPDX-License-Identifier: BSD-3-Clause
// Two descriptors of every feature point, from model file to pose.
#include <catch2/catch.hpp>

#include "tests/support/command.hpp"

namespace posevote::fused_test {

using namespace posevote::test;

TEST_CASE("fused descriptors find what is there, from a cached library too", "[run]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write("spec.yaml",
                                        "seed: 5\n"
                                        "models:\n"
                                        "  - {shape: figure, seed: 3, size: 0.2}\n"
                                        "scenes:\n"
                                        "  - {sensor: rgbd, objects: [1], clutter: 1}\n");
  const std::string data = (folder / "data").string(), out = (folder / "out").string();
  REQUIRE(run_posevote(folder, "simulate " + spec + " --out " + data).status == 0);
  std::string first;
  for (const std::string more : {"", "--threads 1"}) {
    std::filesystem::remove_all(out);
    const CommandResult run =
        run_posevote(folder, "run demo --pipeline recognize_fused --dataset " + data + " --out " +
                                 out + " " + more);
    INFO(run.output);
    REQUIRE(run.status == 0);
    const auto frame = read_json(folder / "out/results.json")["frames"][0];
    REQUIRE(!frame["detections"].empty());
    CHECK(frame["detections"][0]["score"].get<double>() > 0.5);
    CHECK(frame["stages"].contains("fuse_scene"));
    nlohmann::json list = frame["detections"];
    for (nlohmann::json& detection : list) detection.erase("seconds");
    const std::string detections = list.dump();
    if (first.empty()) first = detections;
    CHECK(detections == first);  // blocks come back from the cached file
  }
}

}  // namespace posevote::fused_test
