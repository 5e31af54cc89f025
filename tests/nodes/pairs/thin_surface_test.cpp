// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/thin_surface.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/shapes.hpp"

namespace posevote::thin_surface_test {
namespace {

/// Two walls that meet in the edge x = z = 0: z = 0 for x < 0, and x = 0 for z < 0.
Cloud edge_of_a_box() {
  Cloud cloud{PointMatrix(3200, 3), PointMatrix(3200, 3), {}};
  for (int i = 0; i < 1600; ++i) {
    const float a = 0.001F * (static_cast<float>(i % 40) + 0.5F);
    const float b = 0.001F * (static_cast<float>(i / 40) + 0.5F);
    cloud.points.row(2 * i) << -a, b, 0;
    cloud.normals.row(2 * i) << 0, 0, 1;
    cloud.points.row(2 * i + 1) << 0, b, -a;
    cloud.normals.row(2 * i + 1) << 1, 0, 0;
  }
  return cloud;
}

}  // namespace

TEST_CASE("a thin surface keeps both sides of an edge", "[pairs]") {
  const Cloud thin = pairs::thin_surface(edge_of_a_box(), 0.01F);
  CHECK(thin.points.rows() < 60);
  CHECK(thin.points.rows() >= 32);
  for (Eigen::Index i = 0; i < thin.points.rows(); ++i) {
    const bool top = thin.normals(i, 2) > 0.5F;
    CHECK(thin.normals.row(i).maxCoeff() == Approx(1));
    CHECK(std::abs(thin.points(i, top ? 2 : 0)) < 1e-6F);
  }
}

TEST_CASE("normals of a few stray points make none", "[pairs]") {
  Cloud cloud = edge_of_a_box();
  for (Eigen::Index i = 0; i < cloud.points.rows(); i += 60) cloud.normals.row(i) << 0, 1, 0;
  const Cloud thin = pairs::thin_surface(cloud, 0.01F);
  CHECK(thin.normals.col(1).maxCoeff() < 0.1F);
}

TEST_CASE("what has no normal is left out, and nothing stays nothing", "[pairs]") {
  Cloud cloud = edge_of_a_box();
  cloud.normals.row(5).setZero();
  cloud.points(6, 1) = std::numeric_limits<float>::quiet_NaN();
  const Cloud thin = pairs::thin_surface(cloud, 0.0005F);
  CHECK(thin.points.rows() == cloud.points.rows() - 2);
  CHECK(thin.points.allFinite());
  CHECK(pairs::thin_surface({}, 0.01F).points.rows() == 0);
}

TEST_CASE("a thin surface has the mean colours of its points", "[pairs]") {
  Cloud cloud = edge_of_a_box();
  CHECK(pairs::thin_surface(cloud, 0.01F).colors.rows() == 0);
  cloud.colors = ColorMatrix::Zero(cloud.points.rows(), 3);
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i)
    cloud.colors(i, 0) = cloud.normals(i, 2) > 0.5F ? 1.0F : 0.25F;
  const Cloud thin = pairs::thin_surface(cloud, 0.01F);
  REQUIRE(thin.colors.rows() == thin.points.rows());
  for (Eigen::Index i = 0; i < thin.points.rows(); ++i)
    CHECK(thin.colors(i, 0) == Approx(thin.normals(i, 2) > 0.5F ? 1.0F : 0.25F));
}

}  // namespace posevote::thin_surface_test
