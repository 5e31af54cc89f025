// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/evaluate.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "nodes/formats/write_ply.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace posevote;
using Catch::Contains;
using posevote::test::TemporaryFolder;

namespace {

constexpr const char* kHeader = "scene_id,im_id,obj_id,score,R,t,time\n";
const std::string kIdentity = "1 0 0 0 1 0 0 0 1";
const std::string kFlip = "-1 0 0 0 -1 0 0 0 1";  // 180 deg about z

/// Two objects of one shape, a bar of 200 x 40 x 20 mm with its centre at (10, 0, 0); object 2 is
/// declared symmetric by 180 deg about the z axis through its centre. Image 3 of scene 1 holds two
/// instances of object 1 at (0, 0, 1000) and (300, 0, 1000) mm and one of object 2 at (0, 200,
/// 1000).
class Set : public TemporaryFolder {
 public:
  Set() {
    Mesh bar;
    bar.points.resize(8, 3);
    for (int i = 0; i < 8; ++i)
      bar.points.row(i) << (i & 1 ? 110.F : -90.F), (i & 2 ? 20.F : -20.F), (i & 4 ? 10.F : -10.F);
    std::filesystem::create_directories(*this / "models");
    formats::write_ply(*this / "models/obj_000001.ply", bar);
    formats::write_ply(*this / "models/obj_000002.ply", bar);
    const std::string box =
        R"("diameter": 205, "min_x": -90, "min_y": -20, "min_z": -10, "size_x": 200, "size_y": 40, "size_z": 20)";
    write("models/models_info.json",
          "{\"1\": {" + box + "}, \"2\": {" + box +
              R"(, "symmetries_discrete": [[-1,0,0,20, 0,-1,0,0, 0,0,1,0, 0,0,0,1]]}})");
    write("test/000001/scene_gt.json", R"({"3": [)" + entry(1, "0, 0, 1000") + "," +
                                           entry(1, "300, 0, 1000") + "," +
                                           entry(2, "0, 200, 1000") + "]}");
  }
  static std::string entry(int obj_id, const std::string& t) {
    return R"({"cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [)" + t + R"(], "obj_id": )" +
           std::to_string(obj_id) + "}";
  }
  Evaluation evaluate(const std::string& rows) const {
    EvaluateOptions options;
    options.rules = "pose,add";
    return evaluate(rows, options);
  }
  Evaluation evaluate(const std::string& rows, EvaluateOptions options) const {
    options.results = write("results.csv", kHeader + rows);
    return posevote::evaluate(layouts::read_ground_truth(path(), "test"),
                              read_results_csv(options.results), options);
  }
};

std::string row(int obj_id, double score, const std::string& r, const std::string& t) {
  return "1,3," + std::to_string(obj_id) + "," + std::to_string(score) + "," + r + "," + t +
         ",0.5\n";
}

void check(const RuleResult& result, int instances, int detections, int correct) {
  const Counts& counts = result.counts;
  CHECK(counts.instances == instances);
  CHECK(counts.detections == detections);
  CHECK(counts.correct == correct);
}

}  // namespace

TEST_CASE("perfect results", "[evaluate]") {
  const Evaluation got =
      Set().evaluate(row(1, 0.5, kIdentity, "300 0 1000") + row(1, 0.9, kIdentity, "0 0 1000") +
                     row(2, 0.7, kIdentity, "0 200 1000"));
  check(got.all[0], 3, 3, 3);
  check(got.all[1], 3, 3, 3);
  CHECK(got.all[0].counts.recall() == 1);
  CHECK(got.all[0].counts.precision() == 1);
  CHECK(got.all[0].counts.f1() == 1);
  REQUIRE(got.instances.size() == 3);
  CHECK(got.instances[0].score == 0.9);
  CHECK(got.instances[1].score == 0.5);
  for (const InstanceResult& instance : got.instances) {
    CHECK(instance.errors.center * 1000 < 1e-3);
    CHECK(instance.errors.rotation * 57.3 < 1e-3);
    CHECK(instance.errors.add * 1000 < 1e-3);
  }
}

TEST_CASE("what is off is measured, and each rule judges for itself", "[evaluate]") {
  const Set set;
  // 60 mm along x: too far by either rule (ADD 60 > 20.5).
  Evaluation got = set.evaluate(row(1, 0.9, kIdentity, "60 0 1000"));
  CHECK(got.instances[0].found);
  CHECK(got.instances[0].errors.center * 1000 == Approx(60));
  CHECK(got.instances[0].errors.add * 1000 == Approx(60));
  CHECK_FALSE(got.instances[0].met[0]);
  CHECK_FALSE(got.instances[0].met[1]);
  CHECK_FALSE(got.instances[1].found);
  check(got.objects.at(1)[0], 2, 1, 0);
  // 30 mm: right by the pose rule only.
  got = set.evaluate(row(1, 0.9, kIdentity, "30 0 1000"));
  CHECK(got.instances[0].met[0]);
  CHECK_FALSE(got.instances[0].met[1]);
  // 8 deg about z, through the centre (10, 0, 0): t = c - R c. Right by ADD only.
  const double a = 8 * M_PI / 180, c = std::cos(a), s = std::sin(a);
  char r[128], t[64];
  std::snprintf(r, sizeof r, "%.12f %.12f 0 %.12f %.12f 0 0 0 1", c, -s, s, c);
  std::snprintf(t, sizeof t, "%.12f %.12f 1000", 10 - 10 * c, -10 * s);
  got = set.evaluate(row(1, 0.9, r, t));
  CHECK(got.instances[0].errors.center * 1000 < 1e-3);
  CHECK(got.instances[0].errors.rotation * 180 / M_PI == Approx(8));
  CHECK(got.instances[0].errors.add * 1000 == Approx(2 * std::sin(a / 2) * std::hypot(100, 20)));
  CHECK_FALSE(got.instances[0].met[0]);
  CHECK(got.instances[0].met[1]);
  CHECK(got.all[1].counts.recall() == Approx(1.0 / 3));
  CHECK(got.all[1].counts.precision() == 1);
  CHECK(got.all[1].counts.f1() == Approx(0.5));
}

TEST_CASE("two detections of one instance: one is a false positive", "[evaluate]") {
  const Evaluation got =
      Set().evaluate(row(1, 0.6, kIdentity, "0 0 1000") + row(1, 0.8, kIdentity, "2 0 1000"));
  check(got.objects.at(1)[0], 2, 2, 1);
  CHECK(got.instances[0].score == 0.8);
  CHECK(got.instances[0].errors.center * 1000 == Approx(2));
  CHECK_FALSE(got.instances[1].met[0]);
}

TEST_CASE("a wrong pose of high score takes no instance from a right one", "[evaluate]") {
  const Evaluation got =
      Set().evaluate(row(1, 0.9, kIdentity, "70 0 1000") + row(1, 0.2, kIdentity, "0 0 1000"));
  check(got.objects.at(1)[0], 2, 2, 1);
  CHECK(got.instances[0].met[0]);
  CHECK(got.instances[0].score == 0.2);
  CHECK(got.instances[1].score == 0.9);  // the nearest of what is left
  CHECK_FALSE(got.instances[1].met[0]);
}

TEST_CASE("the right place but the wrong object is a miss and a false positive", "[evaluate]") {
  const Evaluation got = Set().evaluate(row(1, 0.9, kIdentity, "0 200 1000"));
  check(got.objects.at(1)[0], 2, 1, 0);
  check(got.objects.at(2)[0], 1, 0, 0);
  check(got.all[1], 3, 1, 0);
}

TEST_CASE("symmetric objects: any of the equal poses is right", "[evaluate]") {
  const Set set;
  // Turned by 180 deg about z through the centre: t = c - R c = (20, 0, 0).
  const Evaluation got =
      set.evaluate(row(1, 0.9, kFlip, "20 0 1000") + row(2, 0.9, kFlip, "20 200 1000"));
  CHECK(got.instances[0].errors.rotation * 180 / M_PI == Approx(180));
  CHECK_FALSE(got.instances[0].met[0]);
  CHECK_FALSE(got.instances[0].met[1]);
  CHECK(got.instances[2].errors.rotation * 180 / M_PI == Approx(0).margin(1e-6));
  CHECK(got.instances[2].errors.add * 1000 == Approx(0).margin(1e-2));
  CHECK(got.instances[2].met[0]);
  CHECK(got.instances[2].met[1]);
}

TEST_CASE("rotations about an axis of symmetry do not count", "[evaluate]") {
  const Set set;
  set.write("models/models_info.json", R"({"1": {"diameter": 205, "min_x": -90, "min_y": -20,
    "min_z": -10, "size_x": 200, "size_y": 40, "size_z": 20,
    "symmetries_continuous": [{"axis": [1, 0, 0], "offset": [0, 0, 0]}]},
    "2": {"diameter": 205, "min_x": -90, "min_y": -20, "min_z": -10, "size_x": 200, "size_y": 40,
    "size_z": 20}})");
  const Evaluation got = set.evaluate(row(1, 0.9, "1 0 0 0 0 -1 0 1 0", "0 0 1000"));
  CHECK(got.instances[0].errors.rotation * 180 / M_PI == Approx(0).margin(1e-6));
  CHECK(got.instances[0].met[0]);
}

TEST_CASE("hardly visible instances are left out, found or not", "[evaluate]") {
  const Set set;
  set.write("test/000001/scene_gt_info.json",
            R"({"3": [{"visib_fract": 0.05}, {"visib_fract": 0.5}, {"visib_fract": 0.09}]})");
  const Evaluation got = set.evaluate(row(1, 0.9, kIdentity, "0 0 1000"));
  CHECK_FALSE(got.instances[0].counted);
  CHECK(got.instances[0].met[0]);
  check(got.objects.at(1)[0], 1, 0, 0);
  check(got.objects.at(2)[0], 0, 0, 0);
  CHECK_THAT(to_text(got, true), Contains("(ok)") && Contains("less than 10 % visible"));
}

TEST_CASE("the table names every rule", "[evaluate]") {
  const std::string text = to_text(Set().evaluate(row(1, 0.9, kIdentity, "3 4 1000")), true);
  CHECK_THAT(text,
             Contains("    1      3      1         -  0.900      5.0     0.0      5.0     ok"));
  CHECK_THAT(text, Contains("pose 50 mm, 7.5 deg") && Contains("ADD/ADI 0.1 diameter"));
  CHECK_THAT(text, Contains("1 of 3, 1 detections"));
}

TEST_CASE("bad rows are named by file and line", "[evaluate]") {
  const Set set;
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
  const auto message = [](const Set& set) -> std::string {
    try {
      set.evaluate("");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  const Set set;
  set.write("test/000001/scene_gt_info.json", R"({"3": [{"visib_fract": 1}]})");
  CHECK_THAT(message(set), Contains("scene_gt_info.json") && Contains("has 1 instances"));
  set.write("test/000001/scene_gt_info.json", R"({"3": [{}, {}, {}]})");
  CHECK_THAT(message(set), Contains("scene_gt_info.json: image 3: ") && Contains("visib_fract"));
  std::filesystem::remove(set / "test/000001/scene_gt_info.json");
  set.write("test/000001/scene_gt.json", R"({"3": [)" + Set::entry(9, "0, 0, 1") + "]}");
  CHECK_THAT(message(set), Contains("models_info.json: has no object 9"));
  set.write("test/000001/scene_gt.json", R"({"3": [)" + Set::entry(1, "0, 0") + "]}");
  CHECK_THAT(message(set), Contains("image 3, instance 0: cam_t_m2c has 2 numbers"));
  set.write("test/000001/scene_gt.json", "[");
  CHECK_THAT(message(set), Contains("scene_gt.json: is no JSON object"));
  std::filesystem::remove_all(set / "test/000001");
  CHECK_THAT(message(set), Contains("no true pose"));
  const Set no_model;
  std::filesystem::remove(no_model / "models/obj_000001.ply");
  CHECK_THAT(message(no_model), Contains("obj_000001.ply"));
}

TEST_CASE("detections below min_score and beyond top K do not count", "[evaluate]") {
  const Set set;
  const std::string rows = row(1, 0.9, kIdentity, "0 0 1000") +
                           row(1, 0.5, kIdentity, "300 0 1000") +
                           row(1, 0.4, kIdentity, "900 0 1000");
  EvaluateOptions options;
  options.rules = "pose";
  options.min_score = 0.5;
  check(set.evaluate(rows, options).objects.at(1)[0], 2, 2, 2);
  options.min_score = 0.6;
  const Evaluation strict = set.evaluate(rows, options);
  check(strict.objects.at(1)[0], 2, 1, 1);
  CHECK(strict.objects.at(1)[0].curve.size() == 3);
  options.min_score = 0;
  options.top = 2;
  check(set.evaluate(rows, options).objects.at(1)[0], 2, 2, 2);
}

TEST_CASE("targets say which images and how many instances count", "[evaluate]") {
  const Set set;
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

TEST_CASE("average recall of MSSD by hand", "[evaluate]") {
  // Shifts of 20.6, 51.3 mm of 205 mm: 0.1005 and 0.2502 diameter, so below the thresholds from
  // 0.15 (8 of 10) and 0.30 (5 of 10) up; the third instance is not found.
  EvaluateOptions options;
  options.rules = "mssd";
  const Evaluation got = Set().evaluate(
      row(1, 0.9, kIdentity, "0 20.6 1000") + row(1, 0.8, kIdentity, "300 51.3 1000"), options);
  CHECK(got.instances[0].met[0] == Approx(0.8));
  CHECK(got.instances[1].met[0] == Approx(0.5));
  CHECK(got.all[0].counts.recall() == Approx(1.3 / 3));
  // Only as many detections as instances count are judged, here one of object 2.
  const Evaluation cut = Set().evaluate(
      row(2, 0.9, kIdentity, "0 900 1000") + row(2, 0.8, kIdentity, "0 200 1000"), options);
  CHECK(cut.instances[2].met[0] == 0);
}

TEST_CASE("what an image lacks cannot be measured, and is said", "[evaluate]") {
  EvaluateOptions options;
  options.rules = "pose,mspd,vsd";
  const Evaluation got = Set().evaluate(row(1, 0.9, kIdentity, "0 0 1000"), options);
  CHECK(got.all[1].unmeasured == 3);
  CHECK(got.all[2].counts.instances == 0);
  CHECK_THAT(to_text(got, true), Contains("needs a depth image") && Contains("3 instances left"));
}

TEST_CASE("ADD-S takes any pose that looks alike, ADD the right one", "[evaluate]") {
  const Set set;
  EvaluateOptions options;
  options.rules = "add,adds";
  // Turned by half about its own centre, (10, 0, 0); object 1 is not declared symmetric.
  const Evaluation got = set.evaluate(
      row(1, 0.9, kFlip, "20 0 1000") + row(1, 0.8, kIdentity, "300 25 1000"), options);
  CHECK(got.instances[0].met == std::vector<double>{0, 1});
  CHECK(got.instances[1].met == std::vector<double>{0, 1});  // ADD 25 mm, 20.5 are allowed
  CHECK(got.all[1].counts.correct == 2);
  CHECK(got.instances[0].errors.adds < 0.002);
  CHECK(calibration_error(got.all[1]) == Approx((0.1 + 0.2) / 2));
  CHECK_THAT(to_text(got, false), Contains("ADD-S 0.1 diameter") && Contains("ECE"));
}

TEST_CASE("a column of confidences takes the place of the scores", "[evaluate]") {
  const TemporaryFolder folder;
  const std::string header = "scene_id,im_id,obj_id,score,R,t,time,confidence\n";
  const std::string rest = "," + kIdentity + ",0 0 1000,0.1";
  const auto rows = read_results_csv(folder.write("a.csv", header + "1,3,1,7" + rest + ",0.5\n"));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].score == 0.5);
  CHECK_THROWS_WITH(read_results_csv(folder.write("b.csv", header + "1,3,1,7" + rest + "\n")),
                    Contains("b.csv:2: has 7 fields, expected 8"));
}
