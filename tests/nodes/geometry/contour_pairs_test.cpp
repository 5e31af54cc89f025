// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/contour_pairs.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "nodes/geometry/icp.hpp"

using namespace posevote;

namespace {

constexpr float kStep = 0.002F;
constexpr float kRadius = 0.033F, kHalf = 0.05F;  // of a can that stands upright
constexpr float kFar = 0.8F, kWall = 1.1F;        // from the sensor in the origin

void add(Cloud& cloud, const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  const Eigen::Index rows = cloud.points.rows();
  for (PointMatrix* matrix : {&cloud.points, &cloud.normals})
    matrix->conservativeResize(rows + 1, 3);
  cloud.points.row(rows) = point;
  cloud.normals.row(rows) = normal;
}

/// The mantle about `center`, as far as its normals are within `most` [rad] of the way to the sensor.
void add_mantle(Cloud& cloud, const Eigen::Vector3f& center, float most) {
  for (float angle = -most; angle <= most; angle += kStep / kRadius)
    for (float y = -kHalf; y <= kHalf; y += kStep) {
      const Eigen::Vector3f normal(std::sin(angle), 0, -std::cos(angle));
      add(cloud, center + kRadius * normal + y * Eigen::Vector3f::UnitY(), normal);
    }
}

/// A plane at depth z that looks at the sensor, but for what stands before it between two columns.
void add_wall(Cloud& cloud, float z, float width, const Eigen::Vector2f& hidden) {
  for (float x = -width; x <= width; x += kStep)
    for (float y = -0.1F; y <= 0.1F; y += kStep)
      if (x < hidden.x() || x > hidden.y()) add(cloud, {x, y, z}, {0, 0, -1});
}

/// A can before a wall, of which the sensor sees the front 35 degrees either way, and nothing on.
struct Can {
  Cloud model, scan;
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();

  Can() {
    add_mantle(model, Eigen::Vector3f::Zero(), std::numbers::pi_v<float>);
    truth.translation() << 0, 0, kFar;
    add_mantle(scan, {0, 0, kFar}, 0.61F);
    const float shadow = kRadius * kWall / kFar + 3 * kStep;  // sensors lose edges
    add_wall(scan, kWall, 0.2F, {-shadow, shadow});
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
  can.scan = {};
  add_mantle(can.scan, {0, 0, kFar}, 0.61F);
  add_wall(can.scan, 0.5F, 0.15F, {-0.01F, 0.01F});  // a board with a slot
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
