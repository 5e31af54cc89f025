// SPDX-License-Identifier: BSD-3-Clause
// What the pairs are is tested with the node (describe_point_pairs_test.cpp).
#include "nodes/describe/point_pair_sums.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/support/instruction_set.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::point_pair_sums_test {
namespace {

constexpr Eigen::Index kPoints = 1000;

struct Found {
  describe::PointPairSums sums{};
  int count = 0;
};

/// Of the first of many points in a ball of radius 1, every ninth of them without a normal.
Found pairs() {
  const auto rows = kPoints + static_cast<Eigen::Index>(geometry::kGridPadding);
  const PointMatrix p = test::shaken(PointMatrix::Zero(rows, 3), 1);
  PointMatrix n = test::shaken(PointMatrix::Ones(rows, 3), 1);
  n.rowwise().normalize();
  for (Eigen::Index i = 5; i < kPoints; i += 9) n.row(i).setConstant(std::nanf(""));
  const Eigen::Vector3f point = p.row(0), normal = n.row(0);
  const std::vector<geometry::GridRun> runs{{0, 700}, {700, 701}, {720, 1000}};
  Found found;
  found.count = describe::add_point_pairs({p.col(0).data(), p.col(1).data(), p.col(2).data(),
                                           n.col(0).data(), n.col(1).data(), n.col(2).data()},
                                          runs.data(), runs.size(),
                                          {point.data(), normal.data(), 1.5F, 0}, found.sums);
  return found;
}

}  // namespace

TEST_CASE("each pair weighs one in the histogram of each angle", "[describe]") {
  const Found found = pairs();
  REQUIRE(found.count > 200);
  for (int angle = 0; angle < describe::PointPairSums::kAngles; ++angle) {
    double sum = 0;
    for (const auto& row : found.sums.sums)
      for (const auto& column : row[angle])
        for (const float weight : column) sum += static_cast<double>(weight);
    CHECK(sum == Approx(found.count).epsilon(1e-5));
  }
}

TEST_CASE("point pairs have the same bits on every instruction set", "[describe]") {
  const Found best = pairs();
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  const Found here = pairs();
  CHECK(here.count == best.count);
  CHECK(std::memcmp(&here.sums, &best.sums, sizeof here.sums) == 0);
}

}  // namespace posevote::point_pair_sums_test
