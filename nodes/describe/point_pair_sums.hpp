// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of the point-pair histogram (describe_point_pairs.cpp): the pairs of one feature
// point with all its neighbours, as many at once as the processor allows. Every lane does the same
// operations in the same order, never fused, and neighbours are added one by one: every processor
// gives the same bits.
#pragma once

#include <cstddef>

#include "nodes/geometry/grid_run.hpp"
#include "nodes/geometry/oriented_columns.hpp"

namespace posevote::describe {

/// Pairs by distance and by each of four angles, interpolated linearly. Bin centres lie at half
/// numbers, so the lower of two bins may be one before the first, the upper one behind the last;
/// entry [row][angle][column] holds what falls between row - 1 and row, column - 1 and column, of
/// the bins, and its four sums go to (row - 1, column - 1), (row - 1, column), (row, column - 1),
/// (row, column).
struct PointPairSums {
  static constexpr int kAngles = 4;
  static constexpr int kDistanceBins = 6;
  static constexpr int kAngleBins = 10;
  float sums[kDistanceBins + 1][kAngles][kAngleBins + 1][4];
};

/// A feature point.
struct PairSource {
  const float* point;   ///< x, y, z
  const float* normal;  ///< unit
  float radius;         ///< of its neighbourhood [m]
  float min_facing;     ///< least cosine between its normal and a neighbour's
};

/// Adds the pairs with all neighbours in the runs, except those where the point itself lies, to
/// `pairs`. Returns how many.
int add_point_pairs(const geometry::OrientedColumns& cloud, const geometry::GridRun* runs,
                    std::size_t run_count, const PairSource& source, PointPairSums& pairs);

}  // namespace posevote::describe
