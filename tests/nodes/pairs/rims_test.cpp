// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/rims.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "nodes/pairs/pair_table.hpp"
#include "tests/support/box_cloud.hpp"
#include "tests/support/bumpy_scene.hpp"

namespace posevote::rims_test {

using namespace posevote::test;

namespace {

constexpr float kSpacing = 0.002F, kRadius = pairs::kRimRadius * kSpacing;
const Eigen::Vector3f kSize(0.04F, 0.08F, 0.12F);

/// How far outside the box a point is, along each axis.
Eigen::Array3f beyond(const Eigen::Vector3f& point) {
  return point.array().abs() - kSize.array() / 2;
}

}  // namespace

TEST_CASE("the ends of a box's faces are its edges", "[pairs]") {
  const auto rims = pairs::find_rims(box_cloud(kSize, kSpacing), kRadius);
  REQUIRE(rims.size() > 500);
  std::size_t exact = 0, along = 0;
  for (const pairs::Rim& rim : rims) {
    CHECK(rim.normal.cwiseAbs().maxCoeff() == Approx(1));
    CHECK(rim.direction.norm() == Approx(1));
    CHECK(std::abs(rim.direction.dot(rim.normal)) < 1e-4F);
    Eigen::Index axis = 0;  // along which the face ends, but for its corners
    along += rim.direction.cwiseAbs().maxCoeff(&axis) > 0.97F ? 1 : 0;
    CHECK(beyond(rim.point).maxCoeff() < kSpacing);
    exact += std::abs(beyond(rim.point)[axis]) < 0.75F * kSpacing ? 1 : 0;
    CHECK(rim.direction[axis] * rim.point[axis] > 0);  // outward
  }
  CHECK(along > rims.size() * 8 / 10);
  CHECK(exact > rims.size() * 8 / 10);
}

TEST_CASE("a body without edges has hardly an end, and nothing stays nothing", "[pairs]") {
  const Cloud bumpy = bumpy_cloud(1, kResolution);
  const auto rims = pairs::find_rims(bumpy, pairs::kRimRadius * kResolution);
  CHECK(std::ssize(rims) < bumpy.points.rows() / 50);
  CHECK(pairs::find_rims({}, kRadius).empty());
  CHECK(pairs::thin_rims({}, 0.01F).empty());
}

TEST_CASE("points without a normal are no ends", "[pairs]") {
  Cloud cloud = box_cloud(kSize, kSpacing);
  const std::size_t before = pairs::find_rims(cloud, kRadius).size();
  for (Eigen::Index i = 0; i + 2 < cloud.points.rows(); i += 9) {
    cloud.normals.row(i).setZero();
    cloud.points(i + 1, 2) = std::numeric_limits<float>::quiet_NaN();
    cloud.normals(i + 2, 0) = std::numeric_limits<float>::infinity();
  }
  const auto rims = pairs::find_rims(cloud, kRadius);
  CHECK(rims.size() > before / 2);
  CHECK(rims.size() < before);
  for (const pairs::Rim& rim : rims)
    CHECK((rim.point.allFinite() && rim.normal.allFinite() && rim.direction.allFinite()));
}

TEST_CASE("thin ends keep both faces of an edge", "[pairs]") {
  const auto rims = pairs::find_rims(box_cloud(kSize, kSpacing), kRadius);
  const auto thin = pairs::thin_rims(rims, 0.01F);
  CHECK(thin.size() < rims.size() / 3);
  std::size_t edges = 0;  // of which the other face's end is near
  for (const pairs::Rim& a : thin)
    for (const pairs::Rim& b : thin)
      if ((a.point - b.point).norm() < 0.01F && a.direction.dot(b.normal) > 0.95F &&
          b.direction.dot(a.normal) > 0.95F)
        ++edges;
  CHECK(edges > thin.size() / 2);
}

TEST_CASE("however many ends a model has, its table stays small", "[pairs]") {
  Model model;
  std::vector<Eigen::RowVector3f> points, normals;
  for (int i = 0; i < 40; ++i)  // 1600 tiles with a gap between them
    for (int j = 0; j < 40; ++j)
      add_rectangle(points, normals,
                    0.03F * Eigen::Vector3f(static_cast<float>(i), static_cast<float>(j), 0),
                    {0.02F, 0, 0}, {0, 0.02F, 0}, kSpacing);
  model.cloud = geometry::cloud_of(points, normals);
  model.resolution = kSpacing;
  model.diagonal = 1.7F;
  const auto table = pairs::index_rims(model, 0.02F);
  CHECK(table->points().size() > 500);
  CHECK(table->points().size() <= 1500);
}

}  // namespace posevote::rims_test
