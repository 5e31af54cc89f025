// SPDX-License-Identifier: BSD-3-Clause
// What counts as found, and what as false.
#include <cmath>

#include "tests/tools/truth_set.hpp"

namespace posevote::evaluate_test {

using namespace posevote::test;
using Catch::Contains;

TEST_CASE("perfect results", "[evaluate]") {
  const Evaluation got = TruthSet().evaluate(row(1, 0.5, kIdentity, "300 0 1000") +
                                             row(1, 0.9, kIdentity, "0 0 1000") +
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
  const TruthSet set;
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
      TruthSet().evaluate(row(1, 0.6, kIdentity, "0 0 1000") + row(1, 0.8, kIdentity, "2 0 1000"));
  check(got.objects.at(1)[0], 2, 2, 1);
  CHECK(got.instances[0].score == 0.8);
  CHECK(got.instances[0].errors.center * 1000 == Approx(2));
  CHECK_FALSE(got.instances[1].met[0]);
}

TEST_CASE("a wrong pose of high score takes no instance from a right one", "[evaluate]") {
  const Evaluation got =
      TruthSet().evaluate(row(1, 0.9, kIdentity, "70 0 1000") + row(1, 0.2, kIdentity, "0 0 1000"));
  check(got.objects.at(1)[0], 2, 2, 1);
  CHECK(got.instances[0].met[0]);
  CHECK(got.instances[0].score == 0.2);
  CHECK(got.instances[1].score == 0.9);  // the nearest of what is left
  CHECK_FALSE(got.instances[1].met[0]);
}

TEST_CASE("the right place but the wrong object is a miss and a false positive", "[evaluate]") {
  const Evaluation got = TruthSet().evaluate(row(1, 0.9, kIdentity, "0 200 1000"));
  check(got.objects.at(1)[0], 2, 1, 0);
  check(got.objects.at(2)[0], 1, 0, 0);
  check(got.all[1], 3, 1, 0);
}

TEST_CASE("symmetric objects: any of the equal poses is right", "[evaluate]") {
  const TruthSet set;
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
  const TruthSet set;
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
  const TruthSet set;
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
  const std::string text = to_text(TruthSet().evaluate(row(1, 0.9, kIdentity, "3 4 1000")), true);
  CHECK_THAT(text,
             Contains("    1      3      1         -  0.900      5.0     0.0      5.0     ok"));
  CHECK_THAT(text, Contains("pose 50 mm, 7.5 deg") && Contains("ADD/ADI 0.1 diameter"));
  CHECK_THAT(text, Contains("1 of 3, 1 detections"));
}

TEST_CASE("detections below min_score and beyond top K do not count", "[evaluate]") {
  const TruthSet set;
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

TEST_CASE("average recall of MSSD by hand", "[evaluate]") {
  // Shifts of 20.6, 51.3 mm of 205 mm: 0.1005 and 0.2502 diameter, so below the thresholds from
  // 0.15 (8 of 10) and 0.30 (5 of 10) up; the third instance is not found.
  EvaluateOptions options;
  options.rules = "mssd";
  const Evaluation got = TruthSet().evaluate(
      row(1, 0.9, kIdentity, "0 20.6 1000") + row(1, 0.8, kIdentity, "300 51.3 1000"), options);
  CHECK(got.instances[0].met[0] == Approx(0.8));
  CHECK(got.instances[1].met[0] == Approx(0.5));
  CHECK(got.all[0].counts.recall() == Approx(1.3 / 3));
  // Only as many detections as instances count are judged, here one of object 2.
  const Evaluation cut = TruthSet().evaluate(
      row(2, 0.9, kIdentity, "0 900 1000") + row(2, 0.8, kIdentity, "0 200 1000"), options);
  CHECK(cut.instances[2].met[0] == 0);
}

}  // namespace posevote::evaluate_test
