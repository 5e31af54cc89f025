// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/nodes/describe/described_body.hpp"

namespace posevote::describe_nd_histogram_test {

using namespace posevote::test;

namespace {

/// One neighbour at a distance, its normal turned by an angle; a distance bin is 1 m wide.
Eigen::RowVectorXf describe_pair(float distance, float degrees, float scale = 1) {
  const float angle = degrees / 57.29578F;
  Cloud cloud;
  cloud.points.setZero(2, 3);
  cloud.points(1, 1) = distance;
  cloud.normals.setZero(2, 3);
  cloud.normals(0, 2) = 1;
  cloud.normals.row(1) << scale * std::sin(angle), 0, scale * std::cos(angle);
  return run_node<FeatureSet>("describe_nd_histogram", {{"radius", "8"}, {"min_neighbours", "1"}},
                              cloud, FeaturePoints{{0}}, Scale{1})
      .descriptors;
}

}  // namespace

TEST_CASE("NDHist: a neighbour falls into the bin of its distance and angle", "[describe]") {
  // Bins are 11.25 deg wide; the fourth has its middle at 39.375 deg, and row 2 at 2.5 m.
  const auto d = describe_pair(2.5F, 39.375F);
  REQUIRE(d.size() == 128);
  // The neighbour is half of what fills the row, whose share is 2.5 / 8.
  CHECK(d[2 * 16 + 3] == Approx(std::sqrt(2.5 / 8 / 2)).epsilon(1e-4));
  CHECK(d.squaredNorm() == Approx(2.5 / 8 / 2).epsilon(1e-4));
}

TEST_CASE("NDHist: counts are shared between distances and between angles", "[describe]") {
  const auto d = describe_pair(3, 45);  // between rows 2 and 3, between columns 3 and 4
  for (const int row : {2, 3})
    for (const int column : {3, 4})
      CHECK(d[row * 16 + column] == Approx(std::sqrt((row + 0.5) / 8 * 0.25 / 1.5)).epsilon(1e-3));
}

TEST_CASE("NDHist: equal and opposite normals fall into the ends", "[describe]") {
  CHECK(describe_pair(0.2F, 0)[0] > 0.1F);
  CHECK(describe_pair(7.9F, 180)[127] > 0.5F);
  CHECK(describe_pair(2.5F, 60).isApprox(describe_pair(2.5F, 60, 1.1F), 1e-4F));
}

}  // namespace posevote::describe_nd_histogram_test
