// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/point_spacing.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace posevote::point_spacing_test {
namespace {

/// The upper median of each point's distance to the nearest that is elsewhere, by asking all.
float spacing_by_all(const PointMatrix& points) {
  std::vector<float> distances;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    float nearest = std::numeric_limits<float>::infinity();
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      const float squared = (points.row(i) - points.row(k)).squaredNorm();
      if (squared > 0) nearest = std::min(nearest, squared);
    }
    distances.push_back(std::sqrt(nearest));
  }
  std::ranges::nth_element(distances, distances.begin() + std::ssize(distances) / 2);
  return distances[distances.size() / 2];
}

/// A sheet of points at random, and a dense heap of which there are `share` of all.
PointMatrix sheet_with_heap(Eigen::Index count, double share, std::mt19937& random) {
  std::uniform_real_distribution<float> uniform(0, 1);
  PointMatrix points(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const float width = static_cast<double>(i) < share * static_cast<double>(count) ? 0.02F : 1.0F;
    points.row(i) << width * uniform(random), width * uniform(random), 0.01F * uniform(random);
  }
  return points;
}

}  // namespace

TEST_CASE("the spacing is that of the nearest neighbours, near and far", "[prepare]") {
  std::mt19937 random(1);
  for (const double share : {0.0, 0.3, 0.7}) {
    PointMatrix points = sheet_with_heap(1500, share, random);
    CAPTURE(share);
    CHECK(geometry::point_spacing(points) == Approx(spacing_by_all(points)).epsilon(1e-5));
    points.array() += 1000.0F;  // a metre has 16000 steps there
    CHECK(geometry::point_spacing(points) == Approx(spacing_by_all(points)).epsilon(1e-5));
    points.row(7).setConstant(3e7F);  // far outliers change nothing
    CHECK(geometry::point_spacing(points) == Approx(spacing_by_all(points)).epsilon(1e-2));
  }
}

TEST_CASE("the spacing of many points is that of a sample", "[prepare]") {
  const int side = 300;
  PointMatrix points(side * side, 3);
  for (int i = 0; i < side * side; ++i)
    points.row(i) << 0.001F * static_cast<float>(i % side), 0.001F * static_cast<float>(i / side),
        1.0F;
  CHECK(geometry::point_spacing(points) == Approx(0.001).epsilon(1e-3));
  points.col(2).setConstant(std::numeric_limits<float>::quiet_NaN());
  CHECK(geometry::point_spacing(points) == 0);
}

TEST_CASE("points in one place have no spacing, in two that between them", "[prepare]") {
  PointMatrix points = PointMatrix::Constant(5000, 3, 0.5F);
  CHECK(geometry::point_spacing(points) == 0);
  CHECK(geometry::point_spacing(PointMatrix(0, 3)) == 0);
  points.bottomRows(4000).setConstant(0.75F);
  CHECK(geometry::point_spacing(points) == Approx(0.25 * std::sqrt(3.0)));
}

}  // namespace posevote::point_spacing_test
