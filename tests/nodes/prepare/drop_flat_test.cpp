// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numeric>

#include "nodes/data/features.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::drop_flat_test {
namespace {

constexpr float kResolution = 0.002F;

/// A floor 40 cm wide with a roof-shaped ridge along y in its middle, 3 cm to either side.
Cloud ridge() {
  constexpr int kSide = 200;
  Cloud cloud;
  cloud.points.resize(kSide * kSide, 3);
  cloud.normals.resize(kSide * kSide, 3);
  for (int i = 0; i < kSide * kSide; ++i) {
    const float x = 0.002F * static_cast<float>(i % kSide - kSide / 2);
    const float y = 0.002F * static_cast<float>(i / kSide - kSide / 2);
    const bool on_ridge = std::abs(x) < 0.03F;
    cloud.points.row(i) << x, y, on_ridge ? 0.03F - std::abs(x) : 0;
    const Eigen::Vector3f slope(on_ridge ? (x < 0 ? -1.0F : 1.0F) : 0, 0, 1);
    cloud.normals.row(i) = slope.normalized();
  }
  return cloud;
}

FeaturePoints all_points(const Cloud& cloud) {
  FeaturePoints points;
  points.indices.resize(static_cast<std::size_t>(cloud.points.rows()));
  std::iota(points.indices.begin(), points.indices.end(), 0U);
  return points;
}

using Values = std::map<std::string, std::string>;

std::vector<std::uint32_t> kept(const Cloud& cloud, const Values& values = {}) {
  return test::run_node<FeaturePoints>("drop_flat", values, cloud, all_points(cloud),
                                       Scale{kResolution})
      .indices;
}

}  // namespace

TEST_CASE("drop_flat keeps what lies on or near a ridge, and no more", "[prepare]") {
  const Cloud cloud = ridge();
  const std::vector<std::uint32_t> indices = kept(cloud);
  std::vector<bool> is_kept(static_cast<std::size_t>(cloud.points.rows()), false);
  for (const std::uint32_t i : indices) is_kept[i] = true;
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
    const float x = std::abs(cloud.points(i, 0));
    if (x < 0.035F) CHECK(is_kept[static_cast<std::size_t>(i)]);
    if (x > 0.075F) CHECK(!is_kept[static_cast<std::size_t>(i)]);
  }
}

TEST_CASE("drop_flat does not care how the scan is turned", "[prepare]") {
  Cloud cloud = ridge();
  const std::size_t before = kept(cloud).size();
  const Eigen::Matrix3f R =
      Eigen::AngleAxisf(1.1F, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  cloud.points = (cloud.points * R.transpose()).eval();
  cloud.normals = (cloud.normals * R.transpose()).eval();
  CHECK(static_cast<double>(kept(cloud).size()) ==
        Approx(static_cast<double>(before)).epsilon(0.2));
}

TEST_CASE("drop_flat takes scans without normals, points, or anything curved", "[prepare]") {
  Cloud cloud = ridge();
  CHECK(kept(cloud, {{"min_relief", "0"}}).size() == all_points(cloud).indices.size());
  cloud.normals.setZero();
  CHECK(kept(cloud).size() == all_points(cloud).indices.size());  // flat everywhere
  CHECK(kept(Cloud{}).empty());
}

}  // namespace posevote::drop_flat_test
