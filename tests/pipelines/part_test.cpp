// SPDX-License-Identifier: BSD-3-Clause
// `posevote simulate` with meshes of the user's own.
#include "tools/part/part.hpp"

#include "nodes/formats/write_ply.hpp"
#include "tests/pipelines/run_world.hpp"
#include "tools/simulate/shapes.hpp"

namespace posevote::part_test {

using namespace posevote::test;
using Catch::Contains;

namespace {

/// A figure, in mm, off its file's origin.
std::string write_part(const TemporaryFolder& folder) {
  Mesh part = make_shape("figure", 3, 0.2);
  part.points.rowwise() += Eigen::RowVector3f(0.3F, 0, 0.1F);
  formats::write_ply(folder / "my part.ply", part, 1000);
  return (folder / "my part.ply").string();
}

}  // namespace

TEST_CASE("simulate --models says how far and how hidden a part is found", "[part]") {
  const TemporaryFolder folder;
  const std::string part = write_part(folder), out = (folder / "out").string();
  const std::string arguments = "simulate --models '" + part + "' --sensor rgbd --out " + out;
  const CommandResult made =
      run_posevote(folder, arguments + " --ranges 0.7 --scans 2 --precision 0.9");
  INFO(made.output);
  REQUIRE(made.status == 0);
  for (const char* said : {"my part, recall over what is visible of it",
                           "0.7 m: ", "False detections at a confidence of 0.5: ", "my part: "})
    CHECK_THAT(made.output, Contains(said));
  const nlohmann::json json = read_json(folder / "out/recall.json");
  CHECK(json["rows"][0]["visible"] == "all");
  CHECK(json["rows"][0]["instances"].get<int>() >= 2);
  CHECK(json["rows"][0]["found"].get<int>() >= 2);  // in full view, 0.7 m off
  CHECK(json["ranges"][0]["scans"] == 2);
  CHECK_THAT(read_text(folder / "out/recall.csv"), Contains("part,range_m,visible,"));
  CHECK_THAT(read_text(folder / "out/recall.svg"), Contains("recall"));
  CHECK(fs::exists(folder / "out/range_0.7_m/results/pictures"));
  const CommandResult again = run_posevote(folder, arguments);
  CHECK(again.status == 2);
  CHECK_THAT(again.output, Contains("is not an empty folder"));
}

TEST_CASE("parts and sensors that cannot be used are refused by name", "[part]") {
  const TemporaryFolder folder;
  const std::string part = write_part(folder);
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const CommandResult made =
        run_posevote(folder, "simulate --out " + (folder / "out").string() + " " + arguments);
    INFO(made.output);
    CHECK(made.status == 2);
    CHECK_THAT(made.output, Contains(why));
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  const std::string good = "--models '" + part + "' ";
  refused("--models " + folder.write("bad.stl", "solid nothing"), "bad.stl: ");
  refused("--models " + folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
          "points.obj: has no faces");
  refused("--models " + (folder / "none.stl").string(), "none.stl: no such file");
  refused(good + "--model-unit m", "diagonal");
  refused(good + "--sensor steroe", "did you mean 'stereo'?");
  refused(good + "--sensor " + folder.write("s.yaml", "{width: 640, fild: 60}"),
          "s.yaml:1:14: fild: unknown key, did you mean 'field'?");
  refused(good + "--ranges 0.15", "is less than the part's diagonal");
  refused("", "expected a spec, or --models");
}

TEST_CASE("a spec may name meshes and sensors of one's own", "[part]") {
  const TemporaryFolder folder;
  write_part(folder);
  folder.write("near.yaml", "{width: 200, height: 150, field: 40, noise: 0.0003}");
  const std::string spec =
      folder.write("spec.yaml",
                   "models: [{file: my part.ply}]\n"
                   "scenes: [{sensor: near.yaml, objects: [1], clutter: 0}]\n");
  const CommandResult made =
      run_posevote(folder, "simulate " + spec + " --out " + (folder / "set").string());
  INFO(made.output);
  REQUIRE(made.status == 0);
  const nlohmann::json gt = read_json(folder / "set/test/000001/scene_gt_info.json");
  CHECK(gt["0"][0]["visib_fract"].get<double>() == 1);
  const nlohmann::json info = read_json(folder / "set/models/models_info.json");
  CHECK(info["1"]["min_x"].get<double>() > 150);  // mm: in the file's own frame
  const auto refused = [&](const std::string& text, const std::string& why) {
    const std::string file = folder.write("bad.yaml", text);
    const CommandResult bad =
        run_posevote(folder, "simulate " + file + " --out " + (folder / "bad").string());
    INFO(bad.output);
    CHECK(bad.status == 2);
    CHECK_THAT(bad.output, Contains(why));
  };
  refused("models: [{file: x.stl, shape: horn}]\nscenes: [{objects: [1]}]", "one of them");
  refused("models: [{file: x.stl}]\nscenes: [{objects: [1]}]", "x.stl: ");
  refused("models: [{shape: horn}]\nscenes: [{objects: [1], sensor: lazer}]",
          "bad.yaml:2:33: scenes[1].sensor: no sensor and no file is called 'lazer', did you mean "
          "'laser'?");
}

TEST_CASE("the threshold and the reach of a tally", "[part]") {
  const std::vector<Verdict> verdicts{
      {0.9, true, 1}, {0.8, true, 2}, {0.7, false, 3}, {0.6, true, 4}};
  CHECK(part::threshold_for(verdicts, 0.99) == 0.8);
  CHECK(part::threshold_for(verdicts, 0.75) == 0.6);
  CHECK_FALSE(part::threshold_for({{0.9, false, 1}}, 0.5));
  const part::Tally judged{{"a"}, {}, verdicts, {1}, {4}, {1}};
  part::Command command;
  CHECK_THAT(
      part::to_text(judged, command),
      Contains("Believe a confidence of 0.80 or more: of such detections 2 of 2 are right") &&
          Contains("1 in 4 scans at 1 m"));
  command.precision = 0.75;
  CHECK_THAT(part::to_text(judged, command), Contains("Believe every") && Contains(": 3 of 4 are"));

  part::Tally tally{{"a"}, {}, {}, {0.5, 1}, {}, {}};
  for (int i = 0; i < 20; ++i) {
    tally.outcomes.push_back({0.5, i % 2 ? 0.9 : 0.3, true, 1, 1});
    tally.outcomes.push_back({1, i % 2 ? 0.9 : 0.3, i % 2 == 1, 1, 1});
  }
  // All at 0.5 m are 20; what is visible by 0.8 at both ranges as many: the first is taken.
  const auto reach = part::reach_of(tally, 1);
  REQUIRE(reach);
  CHECK(reach->range == 0.5);
  CHECK(reach->visible == 0.2);
  CHECK(reach->found == 20);
  for (part::Outcome& outcome : tally.outcomes) outcome.found = false;
  CHECK_FALSE(part::reach_of(tally, 1));
}

}  // namespace posevote::part_test
