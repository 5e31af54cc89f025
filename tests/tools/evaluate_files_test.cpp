// SPDX-License-Identifier: BSD-3-Clause
// The files that an evaluation reads: broken, contradictory, or lacking something.
#include "tests/tools/truth_set.hpp"

namespace posevote::evaluate_files_test {

using namespace posevote::test;
using Catch::Contains;

TEST_CASE("bad rows are named by file and line", "[evaluate]") {
  const TruthSet set;
  const auto message = [&](const std::string& rows) -> std::string {
    try {
      set.evaluate(rows);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string place = (set / "results.csv").string() + ":2: ";
  CHECK_THAT(message("1,3,1,0.5\n"), Contains(place + "has 4 fields, expected 7"));
  CHECK_THAT(message("1,3,x,0.5," + kIdentity + ",0 0 0,1\n"), Contains(place + "obj_id is 'x'"));
  CHECK_THAT(message(row(1, 1, "1 0 0", "0 0 0")), Contains(place + "R has 3 numbers, expected 9"));
  CHECK_THAT(message(row(1, 1, "2 0 0 0 1 0 0 0 1", "0 0 0")), Contains("R is no rotation"));
  CHECK_THAT(message(row(1, 1, "-1 0 0 0 1 0 0 0 1", "0 0 0")), Contains("R is no rotation"));
  CHECK_THAT(message(row(1, 1, kIdentity, "0 0 nan")), Contains(place + "t is 'nan'"));
  CHECK_THAT(message("1,3,1,nan," + kIdentity + ",0 0 0,1\n"), Contains(place + "score is 'nan'"));
  CHECK_THAT(message(row(7, 1, kIdentity, "0 0 0")), Contains(place + "obj_id 7"));
  CHECK_THAT(message("1,4,1,0.5," + kIdentity + ",0 0 0,1\n"),
             Contains(place) && Contains("im_id 4"));
  CHECK(message("") == "accepted");
  CHECK_THROWS_WITH(read_results_csv("/nowhere.csv"), Contains("/nowhere.csv"));
}

TEST_CASE("missing or contradictory truth is named", "[evaluate]") {
  const auto message = [](const TruthSet& set) -> std::string {
    try {
      set.evaluate("");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  const TruthSet set;
  set.write("test/000001/scene_gt_info.json", R"({"3": [{"visib_fract": 1}]})");
  CHECK_THAT(message(set), Contains("scene_gt_info.json") && Contains("has 1 instances"));
  set.write("test/000001/scene_gt_info.json", R"({"3": [{}, {}, {}]})");
  CHECK_THAT(message(set), Contains("scene_gt_info.json: image 3: ") && Contains("visib_fract"));
  std::filesystem::remove(set / "test/000001/scene_gt_info.json");
  set.write("test/000001/scene_gt.json", R"({"3": [)" + TruthSet::entry(9, "0, 0, 1") + "]}");
  CHECK_THAT(message(set), Contains("models_info.json: has no object 9"));
  set.write("test/000001/scene_gt.json", R"({"3": [)" + TruthSet::entry(1, "0, 0") + "]}");
  CHECK_THAT(message(set), Contains("image 3, instance 0: cam_t_m2c has 2 numbers"));
  set.write("test/000001/scene_gt.json", "[");
  CHECK_THAT(message(set), Contains("scene_gt.json: is no JSON: parse error at line 1"));
  std::filesystem::remove_all(set / "test/000001");
  CHECK_THAT(message(set), Contains("no true pose"));
  const TruthSet no_model;
  std::filesystem::remove(no_model / "models/obj_000001.ply");
  CHECK_THAT(message(no_model), Contains("obj_000001.ply"));
}

TEST_CASE("targets say which images and how many instances count", "[evaluate]") {
  const TruthSet set;
  set.write("test/000001/scene_gt_info.json",
            R"({"3": [{"visib_fract": 0.05}, {"visib_fract": 0.5}, {"visib_fract": 0.9}]})");
  set.write("test_targets_bop19.json",
            R"([{"scene_id": 1, "im_id": 3, "obj_id": 1, "inst_count": 1}])");
  const Evaluation got = set.evaluate(row(1, 0.9, kIdentity, "300 0 1000"));
  CHECK_FALSE(got.instances[0].counted);  // the less visible one
  CHECK(got.instances[1].counted);
  CHECK_FALSE(got.instances[2].counted);  // not asked for
  check(got.all[0], 1, 1, 1);
  set.write("test_targets_bop19.json",
            R"([{"scene_id": 1, "im_id": 3, "obj_id": 1, "inst_count": 3}])");
  CHECK_THROWS_WITH(set.evaluate(""), Contains("test_targets_bop19.json: asks for 3 instances"));
}

TEST_CASE("what an image lacks cannot be measured, and is said", "[evaluate]") {
  EvaluateOptions options;
  options.rules = "pose,mspd,vsd";
  const Evaluation got = TruthSet().evaluate(row(1, 0.9, kIdentity, "0 0 1000"), options);
  CHECK(got.all[1].unmeasured == 3);
  CHECK(got.all[2].counts.instances == 0);
  CHECK_THAT(to_text(got, true), Contains("needs a depth image") && Contains("3 instances left"));
}

}  // namespace posevote::evaluate_files_test
