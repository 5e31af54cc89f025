// SPDX-License-Identifier: BSD-3-Clause
// `posevote experiment`, the short form of each.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/support/command.hpp"

namespace posevote::experiment_test {

using namespace posevote::test;
namespace fs = std::filesystem;

TEST_CASE("experiment sensitivity --quick: right under noise, and resumes", "[experiment]") {
  const TemporaryFolder folder;
  const std::string arguments = "experiment sensitivity --quick --out " + (folder / "out").string();
  const CommandResult first = run_posevote(folder, arguments);
  INFO(first.output);
  REQUIRE(first.status == 0);
  CHECK(std::regex_search(first.output, std::regex("posevote +right in 3 of 3")));
  CHECK(std::regex_search(first.output, std::regex("ransac +right in")));
  CHECK(read_text(folder / "out/sensitivity.svg").find("</svg>") != std::string::npos);
  const std::string csv = read_text(folder / "out/sensitivity.csv");
  CHECK(csv.find("0.03,") != std::string::npos);
  const CommandResult second = run_posevote(folder, arguments);
  INFO(second.output);
  CHECK(second.status == 0);
  CHECK(second.output.find("answered already") != std::string::npos);
  CHECK(read_text(folder / "out/sensitivity.csv") == csv);
}

TEST_CASE("experiment uwa: methods side by side on a set with true poses", "[experiment]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write(
      "spec.yaml",
      "models: [{shape: kettle, size: 0.2}]\n"
      "scenes: [{count: 2, ground: unseen, sensor: rgbd, objects: [1], clutter: 1}]\n");
  REQUIRE(run_posevote(folder, "simulate " + spec + " --out " + (folder / "d").string()).status ==
          0);
  const CommandResult result =
      run_posevote(folder, "experiment uwa --methods posevote ransac --dataset " +
                               (folder / "d").string() + " --out " + (folder / "out").string());
  INFO(result.output);
  REQUIRE(result.status == 0);
  CHECK(std::regex_search(result.output, std::regex("posevote +1.000 +1.000 +1.000 +1.000")));
  CHECK(std::regex_search(result.output, std::regex("ransac +[01]")));
  CHECK(read_text(folder / "out/uwa.csv").find("posevote,all,pose,2,2,2.0,1.0,1.0,1.0,1.0,") !=
        std::string::npos);
  CHECK(read_text(folder / "out/uwa.svg").find("</svg>") != std::string::npos);
  CHECK(fs::exists(folder / "out/ransac/evaluation/evaluation.json"));
  REQUIRE(run_posevote(folder, "report " + (folder / "out").string()).status == 0);
  const std::string page = read_text(folder / "out/report.html");
  for (const char* part : {">uwa</h2>", ">posevote</h2>", ">ransac/evaluation</h2>",
                           "<dt>frames answered</dt><dd>2</dd>", "data:image/svg+xml;base64,"})
    CHECK(page.find(part) != std::string::npos);
}

TEST_CASE("experiment --quick makes a small replica of each set and recognises in it",
          "[experiment]") {
  struct Expected {
    std::string name;
    double least_recall;  ///< far below what is measured: four to six images say little
  };
  for (const Expected& expected :
       {Expected{"uwa", 0.8}, {"queens", 0.8}, {"icbin", 0.5}, {"icmi", 0.5}}) {
    const TemporaryFolder folder;
    const CommandResult result =
        run_posevote(folder, "experiment " + expected.name + " --quick --methods posevote --out " +
                                 (folder / "out").string());
    INFO(result.output);
    REQUIRE(result.status == 0);
    CHECK(result.output.find("A replica") != std::string::npos);
    const nlohmann::json report = read_json(folder / "out" / (expected.name + ".json"));
    CHECK(report["rows"][0]["object"] == "all");
    CHECK(report["rows"][0]["recall"].get<double>() >= expected.least_recall);
    CHECK(report["rows"].size() > 2);
    CHECK(read_text(folder / "out" / (expected.name + ".svg")).find("</svg>") != std::string::npos);
  }
}

TEST_CASE("experiment ranges: recall over distance and noise, at several scales", "[experiment]") {
  const TemporaryFolder folder;
  // A replica that is there already is taken: of the finely meshed, which every build can train.
  const std::string spec = folder.write("spec.yaml",
                                        "models: [{shape: figure, seed: 31, size: 0.18}]\n"
                                        "scenes: [{count: 2, sensor: plain, noise: 0.00005, "
                                        "distance: 0.5, objects: [1], clutter: 0}]\n");
  const std::string replica = (folder / "out/replica_every_54").string();
  REQUIRE(run_posevote(folder, "simulate " + spec + " --out " + replica).status == 0);
  const CommandResult result = run_posevote(
      folder, "experiment ranges --every 54 --scales 0.002 --out " + (folder / "out").string());
  INFO(result.output);
  REQUIRE(result.status == 0);
  CHECK(result.output.find("| posevote_2mm, recall at noise of | 0.05 mm |") != std::string::npos);
  CHECK(read_text(folder / "out/ranges_conditions.md").find("| 0.5 m | 1.000 |") !=
        std::string::npos);
  CHECK(read_text(folder / "out/ranges_conditions.csv").find("posevote,0.5,0.05,1,1,1.0,1.0,1.0") !=
        std::string::npos);

  const CommandResult judged =
      run_posevote(folder, "experiment calibration --runs " + replica + "=" +
                               (folder / "out/posevote/results.csv").string() + " --out " +
                               (folder / "judged").string());
  INFO(judged.output);
  REQUIRE(judged.status == 0);
  CHECK(std::regex_search(judged.output, std::regex("replica_every_54 +2 ")));
  const nlohmann::json report = read_json(folder / "judged/calibration.json");
  REQUIRE(report.size() == 2);
  CHECK(report[1]["set"] == "all");
  CHECK(report[0]["ece"].get<double>() < 0.5);
  CHECK(read_text(folder / "judged/calibration.svg").find("as it should be") != std::string::npos);
  CHECK(run_posevote(folder, "experiment calibration").status == 2);
  CHECK(run_posevote(folder, "experiment calibration --runs nowhere").status == 2);
}

TEST_CASE("experiment refuses what it cannot do", "[experiment]") {
  const TemporaryFolder folder;
  CHECK(run_posevote(folder, "experiment cooking").status == 2);
  const CommandResult method = run_posevote(
      folder, "experiment sensitivity --methods magic --out " + (folder / "a").string());
  CHECK(method.status == 2);
  CHECK(method.output.find("magic") != std::string::npos);
  const CommandResult data = run_posevote(
      folder, "experiment sensitivity --methods posevote --dataset nowhere.ply --out " +
                  (folder / "b").string());
  CHECK(data.status == 2);
  CHECK(data.output.find("nowhere.ply") != std::string::npos);
}

TEST_CASE("bench times every stage and writes what it measured", "[bench]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write("spec.yaml",
                                        "models: [{shape: kettle, size: 0.2}]\n"
                                        "scenes: [{sensor: rgbd, objects: [1]}]\n");
  REQUIRE(run_posevote(folder, "simulate " + spec + " --out " + (folder / "d").string()).status ==
          0);
  const std::string json = (folder / "bench.json").string();
  const CommandResult bench =
      run_posevote(folder, "bench demo --repeat 1 --methods posevote --models " +
                               (folder / "d/models").string() + " --scenes " +
                               (folder / "d/scans").string() + " --out " + json);
  INFO(bench.output);
  REQUIRE(bench.status == 0);
  const nlohmann::json ours = read_json(json)["posevote"];
  CHECK(ours["online_s"].get<double>() > ours["stages_s"]["describe_scene"].get<double>());
  CHECK(ours["stages_s"].contains("segment_objects"));
  CHECK(run_posevote(folder, "bench --compare " + json + " " + json).status == 0);
  CHECK(run_posevote(folder, "bench demo --models " + (folder / "d/models").string()).status == 2);
}

TEST_CASE("bench --growth measures one quantity at several sizes", "[bench]") {
  const TemporaryFolder folder;
  const CommandResult bench =
      run_posevote(folder, "bench --growth rotations --repeat 1 --out " + (folder / "g").string());
  INFO(bench.output);
  REQUIRE(bench.status == 0);
  const nlohmann::json rows = read_json(folder / "g.json");
  REQUIRE(rows.size() == 4);
  for (const nlohmann::json& row : rows) {
    CHECK(row["grows"] == "rotations");
    CHECK(row["seconds"].get<double>() > 0);
    CHECK(row["peak_mb"].get<double>() > 10);
    CHECK(std::abs(row["exponent"].get<double>()) < 3);
  }
  CHECK(read_text(folder / "g.svg").find("exponent") != std::string::npos);
  CHECK(run_posevote(folder, "bench --growth weight").status == 2);
}

}  // namespace posevote::experiment_test
