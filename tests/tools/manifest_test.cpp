// SPDX-License-Identifier: BSD-3-Clause
#include "tools/manifest/manifest.hpp"

#include <catch2/catch.hpp>
#include <cctype>
#include <functional>

#include "tests/support/temporary_folder.hpp"
#include "tools/manifest/run_inputs.hpp"

namespace posevote::manifest_test {

using Catch::Contains;
using posevote::test::read_text;
using posevote::test::TemporaryFolder;

namespace {

Manifest some_run() {
  Manifest run;
  run.version = "1.0";
  run.code = "abc";
  run.seed = 1ULL << 63U;
  run.wiring = {{"a", "a(x) -> y"}};
  run.parameters = {{"a.k", "3"}};
  run.dataset = "set";
  run.split = "test";
  run.library_hash = "0123";
  run.models = {{7, "cup", "models/cup.ply", "4567"}};
  run.scans = {{0, "one", {"scans/one.png", 2, 3, Camera{570.3, 570.1, 320, 240, 0.1}}},
               {1, "two\xff", {"scans/two\xff.ply", 0, 1, {}}}};
  run.scans[0].file.color = "rgb/one.jpg";
  run.starts = {{{"posevote", "run"}, "/nowhere", "here", 11, 1.5, "1/2", 0}};
  return run;
}

}  // namespace

TEST_CASE("a manifest is read as it was written", "[manifest]") {
  const TemporaryFolder folder;
  CHECK_FALSE(read_manifest(folder.path()));
  write_manifest(folder.path(), some_run());
  const Manifest read = read_manifest(folder.path()).value();
  CHECK(differences(some_run(), read).empty());
  CHECK(read.seed == 1ULL << 63U);
  REQUIRE(read.scans.size() == 2);
  CHECK(read.scans[0].file.camera->fx == 570.3);
  CHECK(read.scans[0].file.im_id == 3);
  CHECK(read.scans[0].file.color == "rgb/one.jpg");
  CHECK_FALSE(read.scans[1].file.camera);
  CHECK(read.scans[1].file.color.empty());
  CHECK(read.starts[0].shard == "1/2");
  // Written again it is the same, but for nothing: what is no UTF-8 was mended the first time.
  const std::string text = read_text(folder / "run.json");
  write_manifest(folder.path(), read);
  CHECK(read_text(folder / "run.json") == text);
}

TEST_CASE("any flipped bit or missing end of a manifest is noticed by name", "[manifest]") {
  const TemporaryFolder folder;
  write_manifest(folder.path(), some_run());
  const std::string sound = read_text(folder / "run.json");
  for (std::size_t at = 0; at < sound.size(); at += 3) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    if (std::isspace(static_cast<unsigned char>(sound[at]))) continue;  // between the values
    folder.write("run.json", damaged);
    CHECK_THROWS_WITH(read_manifest(folder.path()), Contains("run.json: is "));
    folder.write("run.json", sound.substr(0, at));
    CHECK_THROWS_WITH(read_manifest(folder.path()), Contains("run.json: "));
  }
}

TEST_CASE("what differs between two runs is named, with both", "[manifest]") {
  const Manifest before = some_run();
  const auto differs = [&before](const std::function<void(Manifest&)>& change) {
    Manifest now = before;
    change(now);
    const std::vector<std::string> all = differences(before, now);
    REQUIRE(all.size() == 1);
    return all.front();
  };
  CHECK(differs([](Manifest& run) { run.seed = 2; }) == "--seed was 9223372036854775808, now 2");
  CHECK(differs([](Manifest& run) { run.parameters["a.k"] = "4"; }) ==
        "the parameter a.k was 3, now 4");
  CHECK(differs([](Manifest& run) { run.parameters["a.l"] = "4"; }) ==
        "the parameter a.l was not there");
  CHECK(differs([](Manifest& run) { run.wiring.clear(); }) ==
        "the wiring of the node a is not there any more");
  CHECK(differs([](Manifest& run) { run.models[0].hash = "89"; }) ==
        "the model 7 (cup) was content 4567, now content 89");
  CHECK(differs([](Manifest& run) { run.library_hash = ""; }) ==
        "what the models were made to was 0123, now empty");
  // Whence the models came does not matter where they are the same.
  CHECK(differences(before,
                    [&] {
                      Manifest now = before;
                      now.library = "some.library";
                      now.models[0].file = now.models[0].hash = "";
                      return now;
                    }())
            .empty());
}

TEST_CASE("scans are found from where the run was started", "[manifest]") {
  const TemporaryFolder folder;
  Manifest run = some_run();
  run.starts[0].folder = (folder / "there").string();
  folder.write("there/scans/one.png", "1");
  folder.write("there/rgb/one.jpg", "1");
  write_manifest(folder.path(), run);
  const RunInputs inputs(folder.path());
  CHECK(inputs.why_not().empty());
  const SceneFile scene = inputs.scene(0, "scans/one.png", 0, 0);
  CHECK(scene.path == folder / "there/scans/one.png");
  CHECK(scene.color == folder / "there/rgb/one.jpg");
  CHECK(scene.camera->fy == 570.1);
  CHECK(scene.scene_id == 2);
  // A frame that the manifest does not know, as one that came while the run went on.
  const SceneFile other = inputs.scene(5, "scans/five.png", 1, 5);
  CHECK(other.im_id == 5);
  CHECK_FALSE(other.camera);
  CHECK_THAT(RunInputs(folder / "none").why_not(), Contains("run.json: is not there"));
}

}  // namespace posevote::manifest_test
