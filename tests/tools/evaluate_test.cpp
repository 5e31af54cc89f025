// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/evaluate.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "nodes/write/write_ply.hpp"
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
    Cloud bar;
    bar.points.resize(8, 3);
    for (int i = 0; i < 8; ++i)
      bar.points.row(i) << (i & 1 ? 110.F : -90.F), (i & 2 ? 20.F : -20.F), (i & 4 ? 10.F : -10.F);
    std::filesystem::create_directories(*this / "models");
    write_ply(*this / "models/obj_000001.ply", bar);
    write_ply(*this / "models/obj_000002.ply", bar);
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
    return posevote::evaluate(path(), write("results.csv", kHeader + rows));
  }
};

std::string row(int obj_id, double score, const std::string& r, const std::string& t) {
  return "1,3," + std::to_string(obj_id) + "," + std::to_string(score) + "," + r + "," + t +
         ",0.5\n";
}

void check(const Counts& counts, int instances, int detections, int correct) {
  CHECK(counts.instances == instances);
  CHECK(counts.detections == detections);
  CHECK(counts.correct == correct);
}

}  // namespace

TEST_CASE("perfect results", "[evaluate]") {
  const Evaluation got =
      Set().evaluate(row(1, 0.5, kIdentity, "300 0 1000") + row(1, 0.9, kIdentity, "0 0 1000") +
                     row(2, 0.7, kIdentity, "0 200 1000"));
  check(got.all.pose, 3, 3, 3);
  check(got.all.add, 3, 3, 3);
  CHECK(got.all.pose.recall() == 1);
  CHECK(got.all.pose.precision() == 1);
  CHECK(got.all.pose.f1() == 1);
  REQUIRE(got.instances.size() == 3);
  CHECK(got.instances[0].score == 0.9);
  CHECK(got.instances[1].score == 0.5);
  for (const InstanceResult& instance : got.instances) {
    CHECK(instance.mm < 1e-3);
    CHECK(instance.deg < 1e-3);
    CHECK(instance.add_mm < 1e-3);
  }
}

TEST_CASE("what is off is measured, and each rule judges for itself", "[evaluate]") {
  const Set set;
  // 60 mm along x: too far by either rule (ADD 60 > 20.5).
  Evaluation got = set.evaluate(row(1, 0.9, kIdentity, "60 0 1000"));
  CHECK(got.instances[0].found);
  CHECK(got.instances[0].mm == Approx(60));
  CHECK(got.instances[0].add_mm == Approx(60));
  CHECK_FALSE(got.instances[0].pose_ok);
  CHECK_FALSE(got.instances[0].add_ok);
  CHECK_FALSE(got.instances[1].found);
  check(got.objects.at(1).pose, 2, 1, 0);
  // 30 mm: right by the pose rule only.
  got = set.evaluate(row(1, 0.9, kIdentity, "30 0 1000"));
  CHECK(got.instances[0].pose_ok);
  CHECK_FALSE(got.instances[0].add_ok);
  // 8 deg about z, through the centre (10, 0, 0): t = c - R c. Right by ADD only.
  const double a = 8 * M_PI / 180, c = std::cos(a), s = std::sin(a);
  char r[128], t[64];
  std::snprintf(r, sizeof r, "%.12f %.12f 0 %.12f %.12f 0 0 0 1", c, -s, s, c);
  std::snprintf(t, sizeof t, "%.12f %.12f 1000", 10 - 10 * c, -10 * s);
  got = set.evaluate(row(1, 0.9, r, t));
  CHECK(got.instances[0].mm < 1e-3);
  CHECK(got.instances[0].deg == Approx(8));
  CHECK(got.instances[0].add_mm == Approx(2 * std::sin(a / 2) * std::hypot(100, 20)));
  CHECK_FALSE(got.instances[0].pose_ok);
  CHECK(got.instances[0].add_ok);
  CHECK(got.all.add.recall() == Approx(1.0 / 3));
  CHECK(got.all.add.precision() == 1);
  CHECK(got.all.add.f1() == Approx(0.5));
}

TEST_CASE("two detections of one instance: one is a false positive", "[evaluate]") {
  const Evaluation got =
      Set().evaluate(row(1, 0.6, kIdentity, "0 0 1000") + row(1, 0.8, kIdentity, "2 0 1000"));
  check(got.objects.at(1).pose, 2, 2, 1);
  CHECK(got.instances[0].score == 0.8);
  CHECK(got.instances[0].mm == Approx(2));
  CHECK_FALSE(got.instances[1].pose_ok);
}

TEST_CASE("a wrong pose of high score takes no instance from a right one", "[evaluate]") {
  const Evaluation got =
      Set().evaluate(row(1, 0.9, kIdentity, "70 0 1000") + row(1, 0.2, kIdentity, "0 0 1000"));
  check(got.objects.at(1).pose, 2, 2, 1);
  CHECK(got.instances[0].pose_ok);
  CHECK(got.instances[0].score == 0.2);
  CHECK(got.instances[1].score == 0.9);  // the nearest of what is left
  CHECK_FALSE(got.instances[1].pose_ok);
}

TEST_CASE("the right place but the wrong object is a miss and a false positive", "[evaluate]") {
  const Evaluation got = Set().evaluate(row(1, 0.9, kIdentity, "0 200 1000"));
  check(got.objects.at(1).pose, 2, 1, 0);
  check(got.objects.at(2).pose, 1, 0, 0);
  check(got.all.add, 3, 1, 0);
}

TEST_CASE("symmetric objects: any of the equal poses is right", "[evaluate]") {
  const Set set;
  // Turned by 180 deg about z through the centre: t = c - R c = (20, 0, 0).
  const Evaluation got =
      set.evaluate(row(1, 0.9, kFlip, "20 0 1000") + row(2, 0.9, kFlip, "20 200 1000"));
  CHECK(got.instances[0].deg == Approx(180));
  CHECK_FALSE(got.instances[0].pose_ok);
  CHECK_FALSE(got.instances[0].add_ok);
  CHECK(got.instances[2].deg == Approx(0).margin(1e-6));
  CHECK(got.instances[2].add_mm == Approx(0).margin(1e-2));
  CHECK(got.instances[2].pose_ok);
  CHECK(got.instances[2].add_ok);
}

TEST_CASE("rotations about an axis of symmetry do not count", "[evaluate]") {
  const Set set;
  set.write("models/models_info.json", R"({"1": {"diameter": 205, "min_x": -90, "min_y": -20,
    "min_z": -10, "size_x": 200, "size_y": 40, "size_z": 20,
    "symmetries_continuous": [{"axis": [1, 0, 0], "offset": [0, 0, 0]}]},
    "2": {"diameter": 205, "min_x": -90, "min_y": -20, "min_z": -10, "size_x": 200, "size_y": 40,
    "size_z": 20}})");
  const Evaluation got = set.evaluate(row(1, 0.9, "1 0 0 0 0 -1 0 1 0", "0 0 1000"));
  CHECK(got.instances[0].deg == Approx(0).margin(1e-6));
  CHECK(got.instances[0].pose_ok);
}

TEST_CASE("hardly visible instances are left out, found or not", "[evaluate]") {
  const Set set;
  set.write("test/000001/scene_gt_info.json",
            R"({"3": [{"visib_fract": 0.05}, {"visib_fract": 0.5}, {"visib_fract": 0.09}]})");
  const Evaluation got = set.evaluate(row(1, 0.9, kIdentity, "0 0 1000"));
  CHECK_FALSE(got.instances[0].counted);
  CHECK(got.instances[0].pose_ok);
  check(got.objects.at(1).pose, 1, 0, 0);
  check(got.objects.at(2).pose, 0, 0, 0);
  CHECK_THAT(to_text(got), Contains("(ok)") && Contains("less than 10 % visible"));
}

TEST_CASE("the table names every rule", "[evaluate]") {
  const std::string text = to_text(Set().evaluate(row(1, 0.9, kIdentity, "3 4 1000")));
  CHECK_THAT(text,
             Contains("    1      3      1         -  0.900      5.0     0.0      5.0     ok"));
  CHECK_THAT(text, Contains("pose 50 mm, 7.5 deg") && Contains("ADD/ADI 0.1 diameter"));
  CHECK_THAT(text, Contains("1 of 3 instances, 1 detections"));
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
  CHECK_THROWS_WITH(posevote::evaluate(set.path(), "/nowhere.csv"), Contains("/nowhere.csv"));
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
