// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/ground.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "nodes/geometry/extreme_points.hpp"
#include "tests/support/box_cloud.hpp"

namespace posevote::ground_test {
namespace {

constexpr float kEdge = 0.1F, kSpacing = 0.002F, kDepth = 2 * kSpacing;  // [m]

Model cube() {
  Model model;
  model.cloud = test::box_cloud(Eigen::Vector3f::Constant(kEdge), kSpacing);
  model.outline.hull = geometry::extreme_points(model.cloud.points).cast<float>();
  model.diagonal = kEdge * std::sqrt(3.0F);
  return model;
}

/// A table 1 m before the sensor, and what else `add` puts there.
template <typename Add>
Cloud table(const Add& add, float width = 0.4F) {
  std::vector<Eigen::RowVector3f> points, normals;
  add(points, normals);
  test::add_rectangle(points, normals, {0, 0, 1}, {0, width, 0}, {width, 0, 0}, kSpacing);
  return geometry::cloud_of(points, normals);
}

Cloud table(float width = 0.4F) {
  return table([](auto&, auto&) {}, width);
}

double share(const Cloud& scan, float x, float z) {
  const geometry::RangeView view(scan, kSpacing);
  REQUIRE(view.usable());
  return poses::Ground(scan, kDepth)
      .share_inside(cube(), Eigen::Isometry3d(Eigen::Translation3d(double(x), 0, double(z))), view);
}

}  // namespace

TEST_CASE("what stands on the ground is not in it, what is put lower is", "[poses]") {
  const Cloud scan = table();
  CHECK(share(scan, 0, 1 - 0.5F * kEdge) == 0);
  CHECK(share(scan, 0, 1 - 0.5F * kEdge + 0.8F * kDepth) == 0);  // nearly
  CHECK(share(scan, 0, 1 - 2 * kEdge) == 0);
  CHECK(share(scan, 0, 1) == Approx(0.5).margin(0.05));
  CHECK(share(scan, 0.1F, 1) == share(scan, 0, 1));
}

TEST_CASE("of two poses the one that reaches into the ground on which the other stands is behind",
          "[poses]") {
  const poses::Ground ground(table(), kDepth);
  const auto at = [](double height, double turn = 0) {
    Eigen::Isometry3d T(Eigen::Translation3d(0, 0, 1 - height));
    T.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX()));
    return T;
  };
  const double half = 0.5 * double(kEdge), depth = (std::sqrt(2.0) - 1) * half / double(kDepth);
  const auto lead = [&](const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
    return ground.lead_over(cube(), one, other);
  };
  CHECK(lead(at(half), at(half, M_PI / 4)) == Approx(depth - 1).epsilon(0.05));
  CHECK(lead(at(half, M_PI / 4), at(half)) == Approx(1 - depth).epsilon(0.05));
  CHECK(lead(at(half), at(half, M_PI / 2)) == 0);
  CHECK(lead(at(half), at(half + 0.8 * double(kDepth), M_PI / 2)) == 0);
  CHECK(lead(at(2 * half), at(half, M_PI / 4)) == 0);  // on something else
  CHECK(lead(at(0), at(0, M_PI / 4)) == 0);            // in something lower, or not of this ground
}

TEST_CASE("the ground says nothing where it is not seen", "[poses]") {
  CHECK(share(table(), 0.4F, 1) == 0);           // beside the table
  CHECK(share(table(), 0, 1 + 2 * kEdge) == 0);  // below it
  const Cloud covered = table([](auto& points, auto& normals) {
    test::add_rectangle(points, normals, {0, 0, 0.8F}, {0, 0.2F, 0}, {0.2F, 0, 0}, kSpacing);
  });
  CHECK(share(covered, 0, 1) == 0);
}

TEST_CASE("a face that lies in the largest plane is no ground", "[poses]") {
  CHECK(share(table(), 0, 1 + 0.5F * kEdge) == 0);
}

TEST_CASE("the ground is the plane of its points, however small: normals may be off", "[poses]") {
  const float times = GENERATE(1.0F, 1.0F / 64);
  Cloud scan = table();
  for (Eigen::Index i = 0; i < scan.normals.rows(); ++i)
    scan.normals.row(i) = Eigen::RowVector3f(0.2F, 0.1F, -1).normalized();
  scan.points *= times;
  Model model = cube();
  model.cloud.points *= times;
  model.outline.hull *= times;
  model.diagonal *= times;
  const geometry::RangeView view(scan, times * kSpacing);
  const poses::Ground ground(scan, times * kDepth);
  const auto share_at = [&](double x, double z) {
    const Eigen::Translation3d place(times * x, 0, times * z);
    return ground.share_inside(model, Eigen::Isometry3d(place), view);
  };
  for (const double x : {-0.1, 0.0, 0.1}) {
    CHECK(share_at(x, 1 - 0.5 * double(kEdge)) == 0);
    CHECK(share_at(x, 1) == Approx(0.5).margin(0.05));
  }
}

TEST_CASE("a plane no larger than what may be seen of the object is no ground", "[poses]") {
  CHECK(share(table(0.25F), 0, 1) > 0.4);
  CHECK(share(table(0.18F), 0, 1) == 0);
}

TEST_CASE("a plane below which the sensor sees where the object would be is no ground", "[poses]") {
  const auto around_pit = [](float pit) {
    std::vector<Eigen::RowVector3f> points, normals;
    const float border = (0.4F - pit) / 2, middle = (pit + border) / 2;
    for (const float side : {-middle, middle}) {
      test::add_rectangle(points, normals, {side, 0, 1}, {0, 0.4F, 0}, {border, 0, 0}, kSpacing);
      test::add_rectangle(points, normals, {0, side, 1}, {0, border, 0}, {pit, 0, 0}, kSpacing);
    }
    test::add_rectangle(points, normals, {0, 0, 1.1F}, {0, pit, 0}, {pit, 0, 0}, kSpacing);
    return geometry::cloud_of(points, normals);
  };
  CHECK(share(around_pit(0.02F), 0, 1) > 0.4);
  CHECK(share(around_pit(0.09F), 0, 1) == 0);
}

TEST_CASE("where nothing is flat there is no ground", "[poses]") {
  Cloud scan = table();
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const float slope = std::sin(static_cast<float>(17 * i)),
                other = std::cos(static_cast<float>(i));
    scan.normals.row(i) = Eigen::RowVector3f(slope, other, -1).normalized();
  }
  CHECK(poses::Ground(scan, 1e-5F)
            .share_inside(cube(), Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1)),
                          geometry::RangeView(scan, kSpacing)) == 0);
  CHECK(poses::Ground(Cloud(), kDepth)
            .share_inside(cube(), Eigen::Isometry3d::Identity(),
                          geometry::RangeView(scan, kSpacing)) == 0);
}

}  // namespace posevote::ground_test
