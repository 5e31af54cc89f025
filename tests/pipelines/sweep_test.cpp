// SPDX-License-Identifier: BSD-3-Clause
// `posevote sweep` beside `run` and `evaluate`.
#include "tests/pipelines/run_world.hpp"

namespace posevote::sweep_test {

using namespace posevote::test;

namespace {

const std::string kConfidence = "segment_objects.min_confidence";
const std::string kPairs = "cast_pairs.references";

std::string set_argument() { return " --dataset " + (world().folder / "data").string(); }
std::string out_argument(const std::string& out) {
  return " --out " + (world().folder / out).string();
}
CommandResult sweep(const std::string& more) {
  return run_posevote(world().folder, "sweep demo" + set_argument() + " " + more);
}

/// The line of the rule over all objects, by `run` and `evaluate`.
nlohmann::json judged_alone(const std::string& confidence, const std::string& pairs) {
  const fs::path out = world().folder / "alone";
  const CommandResult run = run_posevote(
      world().folder, "run demo --overwrite" + set_argument() + out_argument("alone") + " --set " +
                          kConfidence + "=" + confidence + " --set " + kPairs + "=" + pairs);
  INFO(run.output);
  REQUIRE(run.status == 0);
  const CommandResult judged =
      run_posevote(world().folder, "evaluate " + (world().folder / "data").string() + " " +
                                       (out / "results.csv").string() + " --rules adi15 --json");
  REQUIRE(judged.status == 0);
  return nlohmann::json::parse(judged.output)["all"][0];
}

}  // namespace

TEST_CASE("a sweep shares what is not varied, and finds what runs one by one find", "[sweep]") {
  const CommandResult result =
      sweep("--vary " + kConfidence + "=0.5,1 --vary " + kPairs + "=0,300" + out_argument("sweep"));
  INFO(result.output);
  REQUIRE(result.status == 0);
  const nlohmann::json json = read_json(world().folder / "sweep/sweep.json");
  CHECK(json["calls"]["load_scene"] == nlohmann::json{{"asked", 12}, {"made", 3}});
  CHECK(json["calls"]["match_features"]["made"] == 3);
  CHECK(json["calls"]["cast_pairs"]["made"] == 6);
  CHECK(json["calls"]["segment_objects"]["made"] == 12);
  REQUIRE(json["rows"].size() == 4);
  for (const nlohmann::json& row : json["rows"]) {
    INFO(row);
    const nlohmann::json alone = judged_alone(row[kConfidence], row[kPairs]);
    for (const char* key : {"instances", "correct", "detections", "recall", "precision", "f1"})
      CHECK(row[key] == alone[key]);
    CHECK(row["seconds_per_scan"] > 0);
  }
  CHECK(json["rows"][0]["recall"] == 1);  // nobody is as sure as 1
  CHECK(json["rows"][2]["recall"] == 0);
  CHECK(json["best"][0]["values"][kConfidence] == "0.5");
  CHECK(json["best"][0]["not_told_from_it"] == nlohmann::json{2});
  CHECK(result.output.find("best by ADD/ADI 0.15 diameter: " + kConfidence + "=0.5") !=
        std::string::npos);
  CHECK(read_text(world().folder / "sweep/sweep.csv").find("\nadi15,3,1,0,4,") !=
        std::string::npos);
  CHECK(read_text(world().folder / "sweep/sweep.svg").find("</svg>") != std::string::npos);
}

TEST_CASE("what training depends on is trained anew, and the answer is JSON", "[sweep]") {
  const fs::path answer = world().folder / "answer.json";
  const CommandResult result =
      sweep("--vary describe_models.radius=12,15 --json --quiet" + out_argument("radius") + " > " +
            answer.string() + " 2>/dev/null &&:");  // standard output alone
  REQUIRE(result.status == 0);
  const auto json = read_json(answer);
  CHECK(json["calls"]["describe_scene"]["made"] == 6);
  CHECK(json["calls"]["load_scene"]["made"] == 3);
}

TEST_CASE("a sweep takes another's place only where it is told to", "[sweep]") {
  const std::string arguments = "--vary " + kConfidence + "=0.5,0.9" + out_argument("twice");
  REQUIRE(sweep(arguments).status == 0);
  const std::string before = read_text(world().folder / "twice/sweep.json");
  const CommandResult again = sweep(arguments);
  INFO(again.output);
  CHECK(again.status == 2);
  CHECK(again.output.find("sweep.json: is there already; choose another --out") !=
        std::string::npos);
  CHECK(read_text(world().folder / "twice/sweep.json") == before);
  CHECK(sweep(arguments + " --overwrite").status == 0);
}

TEST_CASE("a sweep that was killed goes on with what is left", "[sweep]") {
  const fs::path out = world().folder / "killed";
  const std::string arguments = "--vary " + kConfidence + "=0.5,0.9" + out_argument("killed");
  REQUIRE(sweep(arguments).status == 0);
  nlohmann::json whole = read_json(out / "sweep.json");
  const nlohmann::json status = nlohmann::json::parse(
      run_posevote(world().folder, "status --json " + out.string()).output)["runs"][0];
  CHECK(status["answered"] == 3);
  CHECK(status["left"] == 0);
  // As SIGKILL leaves it in the second scan: the first one's record, and half of another.
  fs::remove(out / "sweep.json");
  const std::string scans = read_text(out / "scans.json");
  const std::size_t second = scans.find("\n{\"frame\":", scans.find("{\"frame\":"));
  world().folder.write("killed/scans.json", scans.substr(0, second + 100));
  CHECK(sweep(arguments).status == 2);  // not unless it is told to
  const CommandResult resumed = sweep(arguments + " --resume");
  INFO(resumed.output);
  REQUIRE(resumed.status == 0);
  nlohmann::json again = read_json(out / "sweep.json");
  const auto first = [](const std::string& text) { return text.substr(0, text.find("},\n")); };
  CHECK(first(read_text(out / "scans.json")) == first(scans));  // not searched again
  for (nlohmann::json* json : {&whole, &again})
    for (nlohmann::json& row : (*json)["rows"]) row.erase("seconds_per_scan");
  CHECK(again == whole);

  const auto refused = [&](const std::string& more, const std::string& why) {
    const CommandResult result = sweep(more + " --resume" + out_argument("killed"));
    INFO(result.output);
    CHECK(result.status == 2);
    CHECK(result.output.find(why) != std::string::npos);
  };
  refused("--vary " + kConfidence + "=0.5,0.8", "--vary was " + kConfidence + "=");
  refused("--vary " + kConfidence + "=0.5,0.9 --seed 7", "--seed was 0, now 7");
  fs::remove(out / "run.json");
  refused("--vary " + kConfidence + "=0.5,0.9", "what the run to resume was is not known");
}

TEST_CASE("a sweep says where its report cannot be written", "[sweep]") {
  const std::string file = world().folder.write("no_folder", "");
  const CommandResult result = sweep("--vary " + kConfidence + "=0.5,0.9 --out " + file + "/out");
  INFO(result.output);
  CHECK(result.status == 2);
  CHECK(result.output.find(file + "/out: cannot be made: Not a directory") != std::string::npos);
}

TEST_CASE("a sweep says what is wrong, and where, before it begins", "[sweep]") {
  const auto refused = [](const std::string& arguments, const std::string& text) {
    const CommandResult result = sweep(arguments + out_argument("refused"));
    INFO(result.output);
    CHECK(result.status == 2);
    CHECK(result.output.find(text) != std::string::npos);
  };
  refused("--vary segment_object.min_confidence=0.1,0.2", "did you mean 'segment_objects'?");
  refused("--vary segment_objects.min_confidense=0.1,0.2", "did you mean 'min_confidence'?");
  refused("--vary " + kConfidence + "=0.5,7", "--vary " + kConfidence + "=7: " + kConfidence);
  refused("--vary " + kConfidence + "=0.5,0.50", "find the same in every scan");
  refused("--vary write_results.format=[csv],[bop]", "find the same in every scan");
  refused("--pipeline recognize_stream --vary " + kConfidence + "=0.1,0.2",
          "carries something from frame to frame");
  const std::string truth = (world().folder / "data/test/000001/scene_gt.json").string();
  fs::rename(truth, truth + ".away");
  refused("--vary " + kConfidence + "=0.1,0.2", "scene_gt.json");
  fs::rename(truth + ".away", truth);
  CHECK_FALSE(fs::exists(world().folder / "refused"));
}

}  // namespace posevote::sweep_test
