// SPDX-License-Identifier: BSD-3-Clause
// What `posevote run` refuses: wrong calls, wrong configs, wrong units.
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/write_ply.hpp"
#include "tests/pipelines/run_world.hpp"
#include "tools/run_lock.hpp"

namespace posevote::run_refused_test {

using namespace posevote::test;

TEST_CASE("arguments that contradict each other, or no run, end with status 2", "[run]") {
  const World& w = world();
  const auto refused = [&w](const std::string& arguments, const std::string& why) {
    const CommandResult run = run_posevote(w.folder, arguments);
    INFO(run.output);
    CHECK(run.status == 2);
    CHECK(run.output.find(why) != std::string::npos);
  };
  const std::string inputs = " --models " + w.models.string() + " " + w.scans_argument() +
                             " --out " + (w.folder / "refused").string();
  refused(
      "run " + (fs::path(POSEVOTE_SOURCE_DIR) / "pipelines/train_models.yaml").string() + inputs,
      "has no `models`");
  refused("run demo --library some.library" + inputs, "one of them");
  refused("run demo --threads 100000" + inputs, "--threads");
  refused("run demo --seed -1" + inputs, "--seed");
  refused("run demo --seed 010" + inputs, "--seed");
  w.folder.write("broken/obj_000007.ply", "ply\n");
  refused("run demo --models " + (w.folder / "broken").string() + " " + w.scans_argument() +
              " --out " + (w.folder / "refused").string(),
          "obj_000007.ply");
  refused("run " + w.scans.string() + inputs, "is a folder");
  const std::string two = w.folder.write("two.yaml", "pipeline: recognize\n---\nmore: {x: 1}\n");
  // yaml-cpp's LoadAll would take all memory for it.
  refused("check " + w.folder.write("comma.yaml", ", 2]}\npipeline: recognize\n"),
          "comma.yaml:1:1: expected a map of keys");
  refused("check " + two, "two.yaml:2:1: starts another YAML document");
  CHECK(!fs::exists(w.folder / "refused"));
}

TEST_CASE("nothing runs, and nothing is written, when the call is wrong", "[run]") {
  const World& w = world();
  const std::string config = w.folder.write("wrong.yaml",
                                            "pipeline: recognize\n"
                                            "load_scene: {unit: miles, unti: mm}\n"
                                            "cast_votes: {rotations: 0, rotations: 60}\n"
                                            "estimate_densty: {sigma_t: 0.01}\n"
                                            "estimate_density: {sigma_t: -1, sigma_r: wide}\n"
                                            "describe_scene: {radius: 3}\n"
                                            "match_features: [1]\n");
  const std::string rest = " --models " + w.models.string() + " " + w.scans_argument() + " --out " +
                           (w.folder / "no").string();
  const CommandResult wrong = run_posevote(w.folder, "run " + config + rest);
  INFO(wrong.output);
  CHECK(wrong.status == 2);
  for (const char* line :
       {":2:20: load_scene.unit: ", ":2:33: load_scene.unti: ", ":3:25: cast_votes.rotations: ",
        ":3:28: cast_votes.rotations: ", ":4:28: estimate_densty.sigma_t: ",
        ":5:29: estimate_density.sigma_t: ", ":5:42: estimate_density.sigma_r: ",
        ":6:26: describe_scene.radius: ", ":7:1: match_features: "})
    CHECK(wrong.output.find(line) != std::string::npos);
  const std::string good = "run demo" + rest;
  for (const std::string& call :
       {"run nowhere.yaml" + rest, good + " --set nothing", good + " --set a.b=c",
        std::string("run demo --out ") + (w.folder / "no").string(), good + " --shard 5/2",
        good + " --on-error maybe", good + " --models /nowhere.ply", good + " --library x",
        std::string("fly")}) {
    const CommandResult run = run_posevote(w.folder, call);
    INFO(call << "\n" << run.output);
    CHECK(run.status == 2);
    CHECK(run.output.size() > 10);
  }
  CHECK_FALSE(fs::exists(w.folder / "no"));
}

TEST_CASE("wrong units fail the frame by name, with the unit that would fit", "[run]") {
  const World& w = world();
  const auto fails = [&w](const std::string& out, const std::string& options,
                          const std::string& advice) {
    const CommandResult run = w.run(out, w.scans_argument() + " " + options);
    INFO(run.output);
    CHECK(run.status == 1);
    const nlohmann::json failures = read_json(w.folder / out / "failures.json");
    REQUIRE(failures.size() == 3);
    CHECK(failures[0]["node"] == "check_size");
    CHECK(failures[0]["what"].get<std::string>().find(advice) != std::string::npos);
    CHECK(run.output.find("000000.ply: check_size: the scan's diagonal is ") != std::string::npos);
    return run.output;
  };
  fails("units_mm", "--scene-unit mm", "is the scan in m, but read as mm? Say --scene-unit m ");
  for (const std::string again : {"units", "units_cached"}) {  // the library says it, too
    const std::string output = fails(again, "--model-unit m", "Say --model-unit mm");
    CHECK(output.find("obj_000001.ply: its diagonal is") != std::string::npos);
    CHECK(output.find("is it in mm? Say --model-unit mm") != std::string::npos);
  }
}

TEST_CASE("scans in mm and models in cm are found by their units", "[run]") {
  const World& w = world();
  const fs::path scan = w.scans / "000000.ply", model = w.models / "obj_000001.ply";
  fs::create_directories(w.folder / "other_units");
  formats::write_ply(w.folder / "other_units/scan.ply", formats::read_mesh(scan, 1), 1000);
  formats::write_ply(w.folder / "other_units/obj_000001.ply", formats::read_mesh(model, 0.001),
                     100);
  const CommandResult run = run_posevote(
      w.folder, "run demo --models " + (w.folder / "other_units/obj_000001.ply").string() +
                    " --scenes " + (w.folder / "other_units/scan.ply").string() +
                    " --scene-unit mm --model-unit cm --out " + (w.folder / "found").string());
  INFO(run.output);
  CHECK(run.status == 0);
  CHECK(run.output.find("warning") == std::string::npos);
  CHECK(frames("found")[0]["detections"].size() == 1);
}

TEST_CASE("one run at a time writes into a folder", "[run]") {
  const World& w = world();
  const std::string again = "--scenes " + (w.scans / "000000.ply").string() + " --overwrite";
  {
    const RunLock held(w.folder / "held");
    const CommandResult refused = w.run("held", again);
    INFO(refused.output);
    CHECK(refused.status == 2);
    CHECK(refused.output.find("held: another run is writing there") != std::string::npos);
    CHECK_FALSE(fs::exists(w.folder / "held/results.json"));
  }
  CHECK(w.run("held", again).status == 0);
}

}  // namespace posevote::run_refused_test
