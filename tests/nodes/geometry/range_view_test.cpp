// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/range_view.hpp"

#include <catch2/catch.hpp>

#include "tests/support/bumpy_scene.hpp"

namespace posevote::range_view_test {

using namespace posevote::test;

namespace {

Cloud wall_at(float z, float half_width) { return test::detail::wall(z, half_width); }

}  // namespace

TEST_CASE("a view knows the range in every direction it saw", "[segment]") {
  const geometry::RangeView view(wall_at(1.0F, 0.2F), kResolution);
  REQUIRE(view.usable());
  for (float x = -0.19F; x < 0.19F; x += 0.0037F) {
    const Eigen::Vector3f on_wall(x, 0.5F * x, 1.0F);
    CHECK(view.measured_range(0.5F * on_wall) == Approx(on_wall.norm()).margin(0.003));
    CHECK(view.measured_range(2.0F * on_wall) == Approx(on_wall.norm()).margin(0.003));
  }
  CHECK(view.measured_range({0.5F, 0, 1}) == 0);
  CHECK(view.measured_range({0, 0, -1}) == 0);
  CHECK(view.measured_range({0, 0, 0}) == 0);
}

TEST_CASE("the nearest surface hides the others, without holes", "[segment]") {
  Cloud scan = wall_at(1.0F, 0.2F);
  test::detail::append(scan, wall_at(0.5F, 0.03F), Eigen::Isometry3d::Identity());
  const geometry::RangeView view(scan, kResolution);
  for (float x = -0.025F; x < 0.025F; x += 0.0013F)
    CHECK(view.measured_range({x, -x, 0.5F}) < 0.51F);
  CHECK(view.measured_range({0.05F, 0, 0.5F}) > 0.9F);
}

TEST_CASE("a view moves with its viewpoint and turns with the scan", "[segment]") {
  Cloud scan;
  scan.points.resize(0, 3);
  scan.normals.resize(0, 3);
  const Eigen::Isometry3d T = pose(3, -2, 1, 2.2);
  test::detail::append(scan, wall_at(1.0F, 0.2F), T);
  scan.view.origin = T.translation().cast<float>();
  const geometry::RangeView view(scan, kResolution);
  REQUIRE(view.usable());
  const Eigen::Vector3f point = (T * Eigen::Vector3d(0.05, -0.1, 0.7)).cast<float>();
  CHECK(view.measured_range(point) ==
        Approx(1.0 / 0.7 * std::sqrt(0.0025 + 0.01 + 0.49)).margin(0.003));
}

TEST_CASE("what is no single view is not used as one", "[segment]") {
  const Cloud body = bumpy_cloud(1, kResolution);
  CHECK_FALSE(geometry::RangeView(body, kResolution).usable());  // the viewpoint lies inside
  Cloud away = wall_at(1.0F, 0.2F);
  away.normals *= -1;
  CHECK_FALSE(geometry::RangeView(away, kResolution).usable());
  Cloud no_normals = wall_at(1.0F, 0.2F);
  no_normals.normals.resize(0, 3);
  CHECK_FALSE(geometry::RangeView(no_normals, kResolution).usable());
  CHECK_FALSE(geometry::RangeView(Cloud{}, kResolution).usable());
  CHECK_FALSE(geometry::RangeView(wall_at(1.0F, 0.2F), 0).usable());
  CHECK(geometry::RangeView(body, kResolution).measured_range({0, 0, 1}) == 0);
}

TEST_CASE("a view of absurd extent takes bounded memory and time", "[segment]") {
  Cloud scan = wall_at(1.0F, 0.05F);
  scan.points.row(0) << 1e6F, 0, 1e6F;
  scan.points.row(1) << 1e-20F, 0, 1e-20F;
  scan.points.row(2).setConstant(std::nanf(""));
  const geometry::RangeView view(scan, 1e-6F);
  CHECK(view.measured_range({std::nanf(""), 0, 1}) == 0);
}

}  // namespace posevote::range_view_test
