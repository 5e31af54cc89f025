// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/describe/local_triangles.hpp"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/nodes/describe/described_body.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::local_triangles_test {

using namespace posevote::test;

namespace {

double area_of(const Cloud& cloud, const std::vector<std::array<int, 3>>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3f p = cloud.points.row(a), q = cloud.points.row(b), r = cloud.points.row(c);
    area += 0.5 * static_cast<double>((q - p).cross(r - p).norm());
  }
  return area;
}

std::vector<std::array<int, 3>> triangles_of(const Cloud& cloud, float circumradius) {
  const FeaturePoints points{{0}};
  return describe::local_triangles(adapters::PclSupport(cloud, points, Scale{kResolution}, 4, 1),
                                   circumradius * kResolution);
}

}  // namespace

TEST_CASE("the triangles of a sampled sphere cover it once", "[describe]") {
  Cloud cloud;
  cloud.points = sphere(4000, 0.05F);
  cloud.normals = cloud.points.rowwise().normalized();
  const auto triangles = triangles_of(cloud, 1.5F);
  const double expected = 4 * M_PI * 0.05 * 0.05;
  CHECK(area_of(cloud, triangles) == Approx(expected).epsilon(0.03));
  CHECK(triangles.size() == Approx(2 * 4000).epsilon(0.03));
  std::vector<char> touched(4000, 0);
  for (const auto& corners : triangles)
    for (const int corner : corners) touched[static_cast<std::size_t>(corner)] = 1;
  CHECK(std::count(touched.begin(), touched.end(), 1) == 4000);
}

TEST_CASE("gaps stay open, and two sides of a thin wall apart", "[describe]") {
  Cloud cloud;
  cloud.points = sphere(4000, 0.05F);
  cloud.normals = cloud.points.rowwise().normalized();
  CHECK(triangles_of(cloud, 0.1F).empty());
  for (Eigen::Index i = 0; i < 4000; i += 2) {  // every second point belongs to a lining
    cloud.points.row(i) *= 0.99F;
    cloud.normals.row(i) *= -1;
  }
  for (const auto& corners : triangles_of(cloud, 1.5F))
    CHECK((corners[0] % 2 == corners[1] % 2 && corners[1] % 2 == corners[2] % 2));
}

}  // namespace posevote::local_triangles_test
