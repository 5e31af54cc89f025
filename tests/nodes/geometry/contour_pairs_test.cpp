// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/contour_pairs.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/box_cloud.hpp"

namespace posevote::contour_pairs_test {
namespace {

constexpr float kStep = 0.002F;
constexpr float kRadius = 0.033F, kHalf = 0.05F;  // of a can that stands upright
constexpr float kFar = 0.8F, kWall = 1.1F;        // from the sensor in the origin

/// What a scan or a model is made of.
struct Surfaces {
  std::vector<Eigen::RowVector3f> points, normals;

  /// The mantle at depth z, as far as its normals are within `most` [rad] of the way to the sensor.
  Surfaces& mantle(float z, float most) {
    for (float angle = -most; angle <= most; angle += kStep / kRadius)
      for (float y = -kHalf; y <= kHalf; y += kStep) {
        const Eigen::RowVector3f normal(std::sin(angle), 0, -std::cos(angle));
        points.emplace_back(kRadius * normal + Eigen::RowVector3f(0, y, z));
        normals.push_back(normal);
      }
    return *this;
  }
  /// A plane at depth z that looks at the sensor, but for a slot in the middle.
  Surfaces& wall(float z, float half_width, float half_slot) {
    const float middle = (half_slot + half_width) / 2, width = half_width - half_slot;
    for (const float x : {-middle, middle})
      test::add_rectangle(points, normals, {x, 0, z}, {width, 0, 0}, {0, -0.2F, 0}, kStep);
    return *this;
  }
  Cloud cloud() const { return geometry::cloud_of(points, normals); }
};

/// A can before a wall, of which the sensor sees the front 35 degrees either way, and nothing on.
struct Can {
  Cloud model = Surfaces().mantle(0, std::numbers::pi_v<float>).cloud(), scan;
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();

  Can() {
    truth.translation() << 0, 0, kFar;
    const float shadow = kRadius * kWall / kFar + 3 * kStep;  // sensors lose edges
    scan = Surfaces().mantle(kFar, 0.61F).wall(kWall, 0.2F, shadow).cloud();
  }

  std::vector<geometry::IcpPair> pairs(const Eigen::Isometry3d& pose, int points = 4000) const {
    const geometry::RangeView view(scan, kStep);
    const geometry::ScanSurface surface(scan, view.usable(), 4 * kStep);
    return geometry::contour_pairs(model, surface, view, pose, kStep, 1e-8, {.points = points});
  }
};

Eigen::Isometry3d beside(const Eigen::Isometry3d& pose, double x) {
  return Eigen::Translation3d(x, 0, 0) * pose;
}

/// By which the pairs would have the model go to the right [m], on average.
double pull(const std::vector<geometry::IcpPair>& pairs) {
  double sum = 0, weight = 0;
  for (const geometry::IcpPair& pair : pairs) {
    sum -= pair.weight * pair.residual * pair.normal.x();
    weight += pair.weight;
  }
  return weight > 0 ? sum / weight : 0;
}

}  // namespace

TEST_CASE("a contour before free space is held back, on either side", "[segment]") {
  const Can can;
  const auto right = can.pairs(beside(can.truth, 0.01)), left = can.pairs(beside(can.truth, -0.01));
  REQUIRE(right.size() > 20);
  REQUIRE(left.size() > 20);
  CHECK(pull(right) < -0.004);
  CHECK(pull(left) > 0.004);
  CHECK(pull(right) > -0.011);
  for (const geometry::IcpPair& pair : right) {
    CHECK(std::abs(pair.normal.y()) < 0.1);  // across the line of sight, outward
    CHECK(pair.normal.norm() == Approx(1).margin(1e-5));
    CHECK(can.model.points.row(pair.row).x() > 0);  // the side that stands out
  }
}

TEST_CASE("between the last of an object and the first behind it a contour is free", "[segment]") {
  const Can can;
  CHECK(can.pairs(can.truth).empty());
  CHECK(can.pairs(beside(can.truth, 0.001)).empty());
}

TEST_CASE("a contour behind something nearer tells nothing", "[segment]") {
  Can can;
  can.scan = Surfaces().mantle(kFar, 0.61F).wall(0.5F, 0.15F, 0.01F).cloud();
  CHECK(can.pairs(beside(can.truth, 0.01)).empty());
}

TEST_CASE("no contour is looked for where none is wanted, or nobody knows free space",
          "[segment]") {
  Can can;
  const Eigen::Isometry3d pose = beside(can.truth, 0.01);
  CHECK(can.pairs(pose, 0).empty());
  can.scan.normals *= -1;  // no single view
  CHECK(can.pairs(pose).empty());
}

}  // namespace posevote::contour_pairs_test
