// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/viewpoint.hpp"

#include <catch2/catch.hpp>
#include <random>

namespace posevote::viewpoint_test {
namespace {

/// Balls of 10 cm on a table, by what faces a sensor at the origin from 1 m.
Scan balls() {
  std::mt19937 random(3);
  std::normal_distribution<float> gauss;
  Scan scan;
  scan.points.resize(6000, 3);
  scan.normals.resize(6000, 3);
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const Eigen::Vector3f center(0.2F * static_cast<float>(i % 3 - 1), 0, 1);
    Eigen::Vector3f normal = Eigen::Vector3f(gauss(random), gauss(random), gauss(random));
    normal.normalize();
    if (normal.dot(center + 0.05F * normal) > 0) normal -= 2 * normal.dot(center) * center;
    normal.normalize();
    Eigen::Vector3f point = center + 0.05F * normal;
    if (i % 2 == 0) {
      normal = Eigen::Vector3f(0, -0.7071F, -0.7071F);
      const Eigen::Vector3f along(0, -0.7071F, 0.7071F);
      point = Eigen::Vector3f(0.3F * gauss(random), 0, 1.05F) + 0.2F * gauss(random) * along;
    }
    scan.points.row(i) = point.transpose();
    scan.normals.row(i) = normal.transpose();
  }
  return scan;
}

/// What a sensor at the origin sees of a wall at 1 m and a ball of 10 cm before it.
Scan ball_before_wall() {
  constexpr int kSide = 200;
  const Eigen::Vector3f center(0, 0, 0.75F);
  Scan scan;
  scan.points.resize(kSide * kSide, 3);
  scan.normals.resize(kSide * kSide, 3);
  for (int i = 0; i < kSide * kSide; ++i) {
    const Eigen::Vector3f wall(0.003F * static_cast<float>(i % kSide - kSide / 2),
                               0.003F * static_cast<float>(i / kSide - kSide / 2), 1);
    const Eigen::Vector3f ray = wall.normalized();
    const float along = ray.dot(center), deep = 0.0025F - (center - along * ray).squaredNorm();
    const bool on_ball = deep > 0;
    const Eigen::Vector3f ball = (along - std::sqrt(std::max(0.0F, deep))) * ray;
    scan.points.row(i) = (on_ball ? ball : wall).transpose();
    scan.normals.row(i) = Eigen::RowVector3f(0, 0, -1);
    if (on_ball) scan.normals.row(i) = (ball - center).normalized().transpose();
  }
  return scan;
}

Scan moved(const Scan& scan, const Eigen::Isometry3f& T) {
  Scan out = scan;
  out.points = (scan.points * T.linear().transpose()).rowwise() + T.translation().transpose();
  out.normals = scan.normals * T.linear().transpose();
  return out;
}

Eigen::Isometry3f motion(float angle, const Eigen::Vector3f& to) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() = Eigen::AngleAxisf(angle, Eigen::Vector3f(1, 2, -1).normalized()).matrix();
  T.translation() = to;
  return T;
}

}  // namespace

TEST_CASE("normals say which places the sensor cannot have stood at", "[geometry]") {
  Scan scan = balls();
  CHECK(*geometry::share_facing(scan, {0, 0, 0}) > 0.95);
  CHECK(*geometry::share_facing(scan, {0, 0, 2}) < 0.1);
  CHECK(*geometry::share_facing(scan, {0, 5, 1}) < 0.6);
  scan.normals.topRows(2000).setZero();
  CHECK(geometry::share_facing(scan, {0, 0, 0}));
  scan.normals.topRows(4000).setZero();
  CHECK_FALSE(geometry::share_facing(scan, {0, 0, 0}));
  scan.normals.resize(0, 3);
  CHECK_FALSE(geometry::share_facing(scan, {0, 0, 0}));
}

TEST_CASE("a scan lies before its sensor, strays aside", "[geometry]") {
  Scan scan = balls();
  scan.points.topRows(20).setZero();
  scan.points.bottomRows(20).setConstant(-9);
  CHECK(geometry::lies_before(scan.points, {0, 0, 0}));
  CHECK_FALSE(geometry::lies_before(scan.points, {0, 0, 1}));
  CHECK_FALSE(geometry::lies_before(scan.points, {0.05F, 0, 0.97F}));
}

TEST_CASE("from the sensor's place all is seen, from behind it is not", "[geometry]") {
  const Scan scan = ball_before_wall();
  CHECK(geometry::share_hidden(scan, {0, 0, 0}) < 0.005);
  CHECK(geometry::share_hidden(scan, {0.8F, 0, 1.8F}) > 0.02);
  CHECK(geometry::share_hidden(scan, {0, 0, 0.9F}) == 1);  // within it
  Scan inverted = scan;
  inverted.normals *= -1;
  CHECK(geometry::share_hidden(inverted, {0, 0, 0}) == geometry::share_hidden(scan, {0, 0, 0}));
}

TEST_CASE("the place that most normals point to is the sensor's, roughly", "[geometry]") {
  for (const float angle : {0.0F, 1.0F, 2.5F}) {
    const Eigen::Isometry3f T = motion(angle, {3, -1, 0.5F});
    const Scan scan = moved(balls(), T);
    const Eigen::Vector3f place = geometry::estimate_viewpoint(scan);
    const Eigen::Vector3f middle = T * Eigen::Vector3f(0, 0, 1);
    const Eigen::Vector3f truth = T.translation() - middle;
    CHECK(std::acos((place - middle).normalized().dot(truth.normalized())) < 0.45F);
    CHECK(*geometry::share_facing(scan, place) > 0.95);
  }
}

}  // namespace posevote::viewpoint_test
