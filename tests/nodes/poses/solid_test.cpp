// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/solid.hpp"

#include <catch2/catch.hpp>

#include "tests/support/box_cloud.hpp"

namespace posevote::solid_test {
namespace {

constexpr float kEdge = 0.1F, kSpacing = 0.002F, kDepth = 0.005F;  // [m]

Cloud cube() { return test::box_cloud(Eigen::Vector3f::Constant(kEdge), kSpacing); }

Eigen::Isometry3d at(float x) { return Eigen::Isometry3d(Eigen::Translation3d(double(x), 0, 1)); }

}  // namespace

TEST_CASE("how far bodies overlap tells how much of one lies in the other", "[poses]") {
  const Cloud body = cube();
  const poses::Solid solid(body, at(0), kDepth);
  CHECK(solid.share_inside(body, at(3 * kEdge)) == 0);
  CHECK(solid.share_inside(body, at(kEdge)) == 0);                    // side by side
  CHECK(solid.share_inside(body, at(kEdge - 0.8F * kDepth)) == 0);    // nearly
  CHECK(solid.share_inside(body, at(0)) == 0);                        // its own surface
  const double overlap = solid.share_inside(body, at(0.8F * kEdge));  // a side, if not its rim
  CHECK(overlap > 0.1);
  CHECK(overlap < 0.2);
  Cloud small = body;
  small.points *= 0.5F;
  CHECK(solid.share_inside(small, at(0)) == 1);
}

TEST_CASE("what is seen from both sides has no inside", "[poses]") {
  Cloud shell = cube();
  Cloud back = shell;
  back.normals *= -1;
  shell.points.conservativeResize(2 * back.points.rows(), 3);
  shell.normals.conservativeResize(2 * back.points.rows(), 3);
  shell.points.bottomRows(back.points.rows()) = back.points;
  shell.normals.bottomRows(back.points.rows()) = back.normals;
  Cloud small = cube();
  small.points *= 0.5F;
  CHECK(poses::Solid(shell, at(0), kDepth).share_inside(small, at(0)) == 0);
}

}  // namespace posevote::solid_test
