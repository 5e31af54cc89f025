// SPDX-License-Identifier: BSD-3-Clause
// The files of real runs are as pipelines/*.schema.json say, to the letter.
#include <fstream>

#include "tests/pipelines/run_world.hpp"

namespace posevote::schema_test {

using namespace posevote::test;

namespace {

CommandResult validate(const std::string& schema, const fs::path& file) {
  const std::string here = POSEVOTE_SOURCE_DIR;
  return run_posevote(world().folder,
                      here + "/tests/pipelines/validate.py " + here + "/pipelines/" + schema +
                          ".schema.json " + file.string(),
                      POSEVOTE_PYTHON);
}

/// Scans of a free form and of a can, which is symmetric, and one scan that cannot be read; a model
/// that cannot be read either. Run once.
const fs::path& checked_run() {
  static const fs::path out = [] {
    const TemporaryFolder& folder = world().folder;
    const std::string spec = folder.write("cans.yaml",
                                          "seed: 6\n"
                                          "models:\n"
                                          "  - {shape: figure, seed: 3, size: 0.2}\n"
                                          "  - {shape: can, seed: 1, size: 0.12}\n"
                                          "scenes:\n"
                                          "  - {sensor: rgbd, objects: [1, 2], clutter: 2}\n"
                                          "  - {sensor: rgbd, objects: [2], clutter: 2}\n");
    const fs::path data = folder / "cans";
    REQUIRE(run_posevote(folder, "simulate " + spec + " --out " + data.string()).status == 0);
    std::ofstream(data / "scans/a \"broken\", one\xff.ply") << "ply\n";
    std::ofstream(data / "models/obj_000009.ply") << "ply\n";
    const CommandResult run = run_posevote(
        folder, "run --models " + (data / "models/*.ply").string() + " --scenes " +
                    (data / "scans").string() + " --set segment_objects.max_instances=2 --out " +
                    (folder / "checked").string());
    INFO(run.output);
    REQUIRE(run.status == 1);  // of the two that cannot be read
    return folder / "checked";
  }();
  return out;
}

}  // namespace

TEST_CASE("results.json and failures.json are as their schemas say", "[run]") {
  const nlohmann::json results = read_json(checked_run() / "results.json");
  // All that the schema speaks of is there.
  std::size_t found = 0, symmetric = 0, rejected = 0, held = 0;
  for (const nlohmann::json& frame : results["frames"]) {
    rejected += frame["rejected"].size();
    CHECK(frame["latency_s"].get<double>() > 0);
    for (const nlohmann::json& detection : frame["detections"]) {
      ++found;
      CHECK(detection["pose_confidence"] <= detection["confidence"]);
      symmetric += detection.contains("symmetries");
      held += detection["covariance"].size() == 36;
      CHECK(detection["seconds"].get<double>() > 0);
    }
  }
  CHECK(found >= 3);
  CHECK(symmetric >= 1);
  CHECK(rejected >= 1);
  CHECK(held == found);
  CHECK(results["models_left_out"].size() == 1);
  CHECK(read_json(checked_run() / "failures.json").size() == 1);
  for (const char* name : {"results", "failures"}) {
    const CommandResult checked = validate(name, checked_run() / (std::string(name) + ".json"));
    INFO(checked.output);
    CHECK(checked.status == 0);
  }
}

TEST_CASE("the schemas refuse what they do not name", "[run]") {
  nlohmann::json results = read_json(checked_run() / "results.json");
  results["frames"][0]["detections"][0]["colour"] = "red";
  const std::string odd = world().folder.write("odd.json", results.dump());
  const CommandResult refused = validate("results", odd);
  CHECK(refused.status == 1);
  CHECK_THAT(refused.output, Catch::Contains("frames/0/detections/0") && Catch::Contains("colour"));
  nlohmann::json failures = read_json(checked_run() / "failures.json");
  failures[0].erase("what");
  CHECK(validate("failures", world().folder.write("odd.json", failures.dump())).status == 1);
}

TEST_CASE("a run writes the formats that it is asked for", "[run]") {
  const World& w = world();
  const std::string one = "--scenes " + (w.scans / "000001.ply").string();
  const fs::path out = w.folder / "table";
  REQUIRE(w.run("table", one + " --format csv").status == 0);
  CHECK(fs::exists(out / "detections.csv"));
  CHECK_FALSE(fs::exists(out / "results.json"));
  CHECK_FALSE(fs::exists(out / "results.csv"));
  CHECK_THAT(read_text(out / "detections.csv"),
             Catch::Contains("000001.ply,") && Catch::Contains(",obj_000001,"));
  const CommandResult resumed = w.run("table", one + " --format csv --resume");
  CHECK(resumed.status == 2);
  CHECK_THAT(resumed.output, Catch::Contains("results.json"));
  const CommandResult odd = w.run("odd", one + " --format csv,xml");
  CHECK(odd.status == 2);
  CHECK_THAT(odd.output, Catch::Contains("--format") && Catch::Contains("xml"));
  REQUIRE(w.run("table", one + " --format json,csv --overwrite").status == 0);
  CHECK(fs::exists(out / "results.json"));
  CHECK(w.run("table", one + " --format json,csv --resume").status == 0);
}

}  // namespace posevote::schema_test
