// SPDX-License-Identifier: BSD-3-Clause
// Every error of the evaluator against values computed by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "tools/evaluate/calibration.hpp"
#include "tools/evaluate/curve.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/surface_discrepancy.hpp"
#include "tools/evaluate/surface_points.hpp"

namespace posevote::evaluate_errors_test {
namespace {

/// A box around the origin [m], two triangles a side.
layouts::TrueObject box(double x, double y, double z) {
  layouts::TrueObject object;
  object.points.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    object.points.row(i) =
        Eigen::RowVector3d(i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z).cast<float>() / 2;
  object.faces.resize(12, 3);
  object.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2,
      2, 4, 6, 1, 3, 5, 3, 7, 5;
  object.diameter = std::sqrt(x * x + y * y + z * z);
  object.symmetries = {Eigen::Isometry3d::Identity()};
  return object;
}

Eigen::Isometry3d at(double x, double y, double z, double angle = 0) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

const Camera kCamera{500, 500, 50, 50, 1};

RangeImage empty_image(int width, int height, float range) {
  return {0, 0, width, height, std::vector<float>(static_cast<std::size_t>(width * height), range)};
}

}  // namespace

TEST_CASE("a shift is the same for every error of points", "[evaluate]") {
  const layouts::TrueObject object = box(0.2, 0.1, 0.05);
  const PoseMeter meter(object);
  const Eigen::Isometry3d a = at(0, 0, 1), b = at(0.003, -0.004, 1);
  CHECK(meter.center(a, b) == Approx(0.005));
  CHECK(meter.rotation(a, b) == Approx(0).margin(1e-9));
  CHECK(meter.add(a, b) == Approx(0.005));
  CHECK(meter.mssd(a, b) == Approx(0.005));
  // The nearest corners, at depth 0.975, move most in the image: 500 * 0.005 / 0.975.
  CHECK(meter.mspd(a, b, kCamera) == Approx(500 * 0.005 / 0.975));
  CHECK(meter.mspd(a, at(0, 0, -1), kCamera) == kBeyond);
  CHECK(meter.mssd(a, at(1, 0, 1)) == kBeyond);
}

TEST_CASE("a turn by a symmetry is no error, any other is", "[evaluate]") {
  layouts::TrueObject object = box(0.2, 0.1, 0.05);
  object.symmetries.push_back(at(0, 0, 0, M_PI));
  const PoseMeter meter(object);
  CHECK(meter.mssd(at(0, 0, 1), at(0, 0, 1, M_PI)) == Approx(0).margin(1e-7));
  CHECK(meter.mspd(at(0, 0, 1), at(0, 0, 1, M_PI), kCamera) == Approx(0).margin(1e-4));
  CHECK(meter.rotation(at(0, 0, 1), at(0, 0, 1, M_PI)) == Approx(0).margin(1e-7));
  // By 90 deg each corner moves by sqrt(2) of its distance from the axis, either way round.
  CHECK(meter.mssd(at(0, 0, 1), at(0, 0, 1, M_PI / 2)) ==
        Approx(std::sqrt(2) * std::hypot(0.1, 0.05)));
}

TEST_CASE("ADI is the mean distance to the closest point, by brute force", "[evaluate]") {
  layouts::TrueObject object = box(0.2, 0.1, 0.05);
  object.symmetries.push_back(at(0, 0, 0, M_PI));
  object.faces.resize(0, 3);
  object.points.resize(900, 3);
  object.points.setRandom();
  object.points *= 0.1F;
  object.diameter = 0.34;
  for (const double shift : {0.001, 0.05, 0.3}) {
    const Eigen::Isometry3d a = at(0, 0, 1), b = at(shift, 0, 1.01, 0.7);
    const Eigen::Matrix3Xd points = object.points.transpose().cast<double>();
    const Eigen::Matrix3Xd found = b * points;
    double sum = 0;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      sum += (found.colwise() - a * points.col(i)).colwise().norm().minCoeff();
    CHECK(PoseMeter(object).add(a, b) == Approx(sum / 900).epsilon(1e-4));
  }
}

TEST_CASE("a continuous symmetry turns in 315 steps about its own axis", "[evaluate]") {
  layouts::TrueObject object = box(0.2, 0.2, 0.05);
  object.axes.push_back({Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0.01, 0, 0)});
  CHECK(symmetry_steps(object).size() == 315);
  const PoseMeter meter(object);
  Eigen::Isometry3d turn = Eigen::Translation3d(0.01, 0, 0) *
                           Eigen::AngleAxisd(1.234, Eigen::Vector3d::UnitZ()) *
                           Eigen::Translation3d(-0.01, 0, 0);
  CHECK(meter.mssd(at(0, 0, 1), at(0, 0, 1) * turn) < 0.01 * object.diameter);
  turn.translation().y() += 0.02;
  CHECK(meter.mssd(at(0, 0, 1), at(0, 0, 1) * turn) == Approx(0.02).margin(0.01 * object.diameter));
}

TEST_CASE("MSSD is the maximum over all points, not only over some", "[evaluate]") {
  layouts::TrueObject object = box(0.2, 0.1, 0.05);
  PointMatrix dense(20008, 3);
  dense.topRows(20000).setRandom();
  dense.topRows(20000) *= 0.02F;
  dense.bottomRows(8) = object.points;
  object.points = dense;
  const double angle = 0.3;
  CHECK(PoseMeter(object).mssd(at(0, 0, 1), at(0, 0, 1, angle)) ==
        Approx(2 * std::sin(angle / 2) * std::hypot(0.1, 0.05)));
}

TEST_CASE("the model is seen where the camera sees it", "[evaluate]") {
  // The front, 0.1 m wide at depth 1: 50 pixels each way, from 25 to 75.
  const layouts::TrueObject object = box(0.1, 0.1, 0.2);
  const RangeImage image = render(object, at(0, 0, 1.1), kCamera, 100, 100);
  CHECK(image.at(50, 50) == Approx(1.0));
  CHECK(image.at(30, 70) == Approx(std::sqrt(1 + 2 * 0.04 * 0.04)));
  CHECK(image.at(26, 50) > 0);
  CHECK(image.at(74, 50) > 0);
  CHECK(image.at(23, 50) == 0);
  CHECK(image.at(77, 50) == 0);
  CHECK(image.at(-1, 500) == 0);
  CHECK(render(object, at(0, 0, -1), kCamera, 100, 100).ranges.empty());
  CHECK(render(object, at(9, 0, 1), kCamera, 100, 100).at(99, 50) == 0);
}

TEST_CASE("VSD: same pose 0, apart 1, half covered by hand", "[evaluate]") {
  const auto window = [](int x, int width, float range) {
    RangeImage image = empty_image(width, 10, range);
    image.x = x;
    return image;
  };
  const RangeImage wall = empty_image(100, 10, 2.0F), none = empty_image(100, 10, 0.0F);
  const auto vsd = [](const RangeImage& seen, const RangeImage& a, const RangeImage& b,
                      Holes holes = Holes::visible) {
    return surface_discrepancy(seen, a, b, 0.015, holes, {0.02})[0];
  };
  const RangeImage a = window(0, 20, 1.0F);
  CHECK(vsd(wall, a, a) == 0);
  CHECK(vsd(wall, a, window(50, 20, 1.0F)) == 1);
  // 10 of 20 columns shared: union 30, 20 of them in one only.
  CHECK(vsd(wall, a, window(10, 20, 1.0F)) == Approx(20.0 / 30));
  // Shared, but 15 mm apart: below tau; 25 mm: not.
  CHECK(vsd(wall, a, window(0, 20, 1.015F)) == 0);
  CHECK(vsd(wall, a, window(0, 20, 1.025F)) == 1);
  // Something at 0.5 m hides both: nothing is visible, which counts as wrong.
  CHECK(vsd(empty_image(100, 10, 0.5F), a, a) == 1);
  // Behind the measured surface by less than delta: visible.
  CHECK(vsd(empty_image(100, 10, 0.99F), a, a) == 0);
  // Without measurements: visible to BOP 2019, not to BOP 2018.
  CHECK(vsd(none, a, a) == 0);
  CHECK(vsd(none, a, a, Holes::hidden) == 1);
  // The found pose lies behind the measured surface, where the true one is seen: it is taken as
  // visible there, and too far away.
  CHECK(vsd(empty_image(100, 10, 1.0F), a, window(0, 20, 1.5F)) == 1);
  // A found surface that is hidden and off the true one costs nothing where none is seen.
  CHECK(vsd(empty_image(100, 10, 1.0F), a, window(0, 30, 1.0F)) == Approx(10.0 / 30));
  RangeImage half_hidden = empty_image(100, 10, 1.0F);
  for (int v = 0; v < 10; ++v)
    for (int u = 10; u < 100; ++u) half_hidden.ranges[static_cast<std::size_t>(v * 100 + u)] = 0.5F;
  CHECK(vsd(half_hidden, a, window(0, 30, 1.0F)) == 0);
}

TEST_CASE("precision-recall curve, best F1 and average precision by hand", "[evaluate]") {
  // Right, wrong, right at 0.9, 0.8, 0.7; a wrong one at 0.2; three instances.
  const std::vector<Verdict> verdicts{{0.7, true}, {0.9, true}, {0.2, false}, {0.8, false}};
  const auto curve = make_curve(verdicts, 3);
  REQUIRE(curve.size() == 4);
  CHECK(curve[0].score == 0.9);
  CHECK(curve[0].counts.precision() == 1);
  CHECK(curve[2].counts.recall() == Approx(2.0 / 3));
  CHECK(curve[2].counts.precision() == Approx(2.0 / 3));
  CHECK(curve[3].counts.precision() == 0.5);
  const auto best = best_f1(curve);
  CHECK(best->score == 0.7);
  CHECK(best->counts.f1() == Approx(2.0 / 3));
  CHECK(average_precision(curve) == Approx(1.0 / 3 + 2.0 / 9));
  // Equal scores are one point: no order among them favours anybody.
  CHECK(make_curve({{0.5, true}, {0.5, false}}, 1).size() == 1);
  CHECK_FALSE(best_f1(make_curve({}, 3)).has_value());
  CHECK(average_precision({}) == 0);
}

TEST_CASE("ADD-S of faces, not of their few corners, by hand", "[evaluate]") {
  layouts::TrueObject sheet;
  sheet.points.resize(4, 3);
  sheet.points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  sheet.faces.resize(2, 3);
  sheet.faces << 0, 1, 2, 0, 2, 3;
  sheet.diameter = std::sqrt(2);
  sheet.center = Eigen::Vector3d(0.5, 0.5, 0);
  sheet.symmetries = {Eigen::Isometry3d::Identity()};
  const PoseMeter meter(sheet);
  const Eigen::Isometry3d truth = at(0, 0, 3);
  CHECK(meter.adds(truth, truth) == Approx(0).margin(1e-6));
  CHECK(meter.adds(truth, at(0, 0, 3.05)) == Approx(0.05).epsilon(0.01));
  // In its own plane only a strip of a tenth sticks out, by half of that on average. The rest lies
  // half a spacing (7 mm) from the closest point. The corners alone would say 0.1.
  CHECK(meter.adds(truth, at(0.1, 0, 3)) == Approx(0.005 + 0.9 * 0.0035).margin(0.001));
  CHECK(meter.add(truth, at(0.1, 0, 3)) == Approx(0.1));
  // A quarter turn about its middle maps it onto itself, though nobody says so.
  const Eigen::Isometry3d turned = at(1, 0, 3, M_PI / 2);
  CHECK(meter.adds(truth, turned) < 0.01);
  CHECK(meter.add(truth, turned) > 0.5);
  CHECK(meter.adds(truth, at(3, 0, 3)) == kBeyond);
}

TEST_CASE("points spread over faces by their area, in the same places each time", "[evaluate]") {
  const layouts::TrueObject object = box(0.2, 0.1, 0.05);
  const PointMatrix points = surface_points(object.points, object.faces, 7000);
  CHECK(points == surface_points(object.points, object.faces, 7000));
  int tops = 0, ends = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3f share =
        points.row(i).transpose().cwiseAbs().cwiseQuotient(Eigen::Vector3f(0.1F, 0.05F, 0.025F));
    REQUIRE(share.maxCoeff() == Approx(1).epsilon(1e-5));
    tops += share.z() > 0.9999F, ends += share.x() > 0.9999F;
  }
  CHECK(tops == Approx(4000).margin(20));  // of 2 (0.02 + 0.01 + 0.005) m^2
  CHECK(ends == Approx(1000).margin(20));
  CHECK(points.colwise().mean().norm() < 0.001F);
}

TEST_CASE("expected calibration error by hand", "[evaluate]") {
  // Bin [0.2, 0.3): mean 0.25, half of two right. Bin [0.9, 1]: mean 0.95, three of four right.
  const std::vector<Verdict> verdicts{{0.2, true},   {0.3 - 1e-9, false}, {0.9, true},
                                      {0.95, false}, {0.95, true},        {1, true}};
  const auto calibration = calibrate(verdicts);
  REQUIRE(calibration);
  CHECK(calibration->count == 6);
  REQUIRE(calibration->bins.size() == 10);
  CHECK(calibration->bins[2].count == 2);
  CHECK(calibration->bins[2].right == Approx(0.5));
  CHECK(calibration->bins[9].count == 4);
  CHECK(calibration->bins[9].mean_score == Approx(0.95));
  CHECK(calibration->error == Approx((2 * 0.25 + 4 * 0.2) / 6));
  CHECK(calibrate({})->error == 0);
  CHECK_FALSE(calibrate({{1.2, true}}));
  CHECK(reliability_csv({{"hand", *calibration}}).find("hand,0.2,0.3,2,0.250000,0.500000\n") !=
        std::string::npos);
  CHECK(reliability_csv({{"hand", *calibration}}).find("hand,0.3,0.4,0,,\n") != std::string::npos);
}

}  // namespace posevote::evaluate_errors_test
