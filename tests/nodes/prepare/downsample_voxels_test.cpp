// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <limits>

#include "nodes/data/features.hpp"
#include "nodes/geometry/select_rows.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::downsample_voxels_test {

using Catch::Matchers::Contains;

namespace {

Cloud downsampled(Cloud cloud, float resolution,
                  const std::map<std::string, std::string>& params = {}) {
  return test::run_node<Cloud>("downsample_voxels", params, std::move(cloud), Scale{resolution});
}

Cloud sphere(int count = 20000) {
  Cloud cloud;
  cloud.points = test::sphere(count, 0.05F);
  cloud.normals = test::sphere(count, 1);
  cloud.view.origin = {1, 2, 3};
  return cloud;
}

}  // namespace

TEST_CASE("downsample_voxels makes one point a voxel: centroid and mean normal", "[prepare]") {
  Cloud cloud;
  cloud.points.resize(4, 3);
  cloud.points << 0, 0, 0, 0.2F, 0.4F, 0.6F, 0.9F, 0.9F, 0.9F, 2.5F, 0, 0;
  cloud.normals.resize(4, 3);
  cloud.normals << 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, -1;
  const Cloud out = downsampled(cloud, 0.5F, {{"leaf_size", "2"}});
  REQUIRE(out.points.rows() == 2);
  CHECK(out.points.row(0).isApprox(Eigen::RowVector3f(1.1F, 1.3F, 1.5F) / 3));
  CHECK(out.normals.row(0).isApprox(Eigen::RowVector3f(1, 2, 0).normalized()));
  CHECK(out.points(1, 0) == 2.5F);
  CHECK(out.normals(1, 2) == -1);
}

TEST_CASE("downsample_voxels thins a surface to its resolution", "[prepare]") {
  const Cloud out = downsampled(sphere(), 0.005F);
  CHECK(out.points.rows() > 1000);  // 4 pi 50^2 / 5^2 = 1257 squares
  CHECK(out.points.rows() < 2200);
  PointMatrix away = out.points;
  away.rowwise().normalize();
  CHECK(test::mean_angle(away, out.normals) < 1.5);
  CHECK((out.normals.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-5F);
  CHECK(out.view.origin == Eigen::Vector3f(1, 2, 3));
  CHECK(downsampled(sphere(), 1e-4F).points.rows() == 20000);  // coarser than the voxels: all stay
}

TEST_CASE("downsample_voxels does not mind the order of the input", "[prepare]") {
  Cloud cloud = sphere();
  cloud.points.bottomRows(9000) = cloud.points.topRows(9000);  // two-sided: voxels that cancel
  cloud.normals.bottomRows(9000) = -cloud.normals.topRows(9000);
  const std::vector<Eigen::Index> order = test::shuffled(cloud.points.rows());
  const Cloud a = downsampled(cloud, 0.004F);
  const Cloud b = downsampled(geometry::select_rows(cloud, order), 0.004F);
  REQUIRE(a.points.rows() == b.points.rows());
  CHECK((a.points - b.points).cwiseAbs().maxCoeff() < 1e-6F);
  CHECK((a.normals - b.normals).cwiseAbs().maxCoeff() < 1e-5F);
}

TEST_CASE("downsample_voxels keeps both sides of a thin wall", "[prepare]") {
  Cloud wall;  // 0.4 mm thick in voxels of 2 mm
  wall.points.resize(20, 3);
  wall.normals.resize(20, 3);
  for (Eigen::Index i = 0; i < 20; ++i) {
    const float side = i % 2 == 0 ? 1.0F : -1.0F;
    wall.points.row(i) << 1e-5F * static_cast<float>(i), 0, 2e-4F * side;
    wall.normals.row(i) << 0.1F, 0, side;
    wall.normals.row(i).normalize();
  }
  const Cloud out = downsampled(wall, 0.002F);
  REQUIRE(out.points.rows() == 2);
  CHECK(out.normals(0, 2) * out.normals(1, 2) < -0.9F);
  for (const int i : {0, 1}) CHECK(out.points(i, 2) * out.normals(i, 2) > 1e-4F);
}

TEST_CASE("downsample_voxels takes huge extents and leaves out what is no point", "[prepare]") {
  Cloud cloud = sphere();
  cloud.points.row(0) << 1e5F, -1e5F, 1e5F;
  cloud.points(1, 2) = std::numeric_limits<float>::quiet_NaN();
  cloud.normals(2, 0) = std::numeric_limits<float>::infinity();
  cloud.normals.row(3).setZero();
  const Cloud out = downsampled(cloud, 0.0005F);
  std::vector<Eigen::Index> usable{0};
  for (Eigen::Index i = 4; i < cloud.points.rows(); ++i) usable.push_back(i);
  CHECK(out.points == downsampled(geometry::select_rows(cloud, usable), 0.0005F).points);
  CHECK(out.points.allFinite());
  CHECK(out.points.maxCoeff() == 1e5F);
  cloud.points(0, 0) = 1e30F;
  CHECK_THROWS_WITH(downsampled(cloud, 0.0005F), Contains("too much for voxels of 0.0005 m"));
}

TEST_CASE("downsample_voxels refuses points without normals", "[prepare]") {
  Cloud cloud = sphere();
  cloud.normals.resize(0, 3);
  CHECK_THROWS_WITH(downsampled(cloud, 0.01F), Contains("no normals"));
  CHECK_THROWS_WITH(downsampled(Cloud{}, 0.01F), Contains("none of its 0 points"));
  CHECK_THROWS_AS(downsampled(sphere(), 0), std::runtime_error);
}

}  // namespace posevote::downsample_voxels_test
