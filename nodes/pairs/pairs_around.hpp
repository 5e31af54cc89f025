// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of PairVotes::go_to: the pairs that one point makes with those around it. It rounds
// as angle_bins (pair_key.hpp) and LocalFrame do. No header of Eigen here, as in grid_run.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/geometry/grid_run.hpp"
#include "nodes/geometry/oriented_columns.hpp"

namespace posevote::pairs {

/// A LocalFrame, and how far its pairs reach.
struct PairStart {
  float point[3], normal[3], u[3], v[3];
  float reach;  ///< [m]
  /// Those that angle_bins leaves out are wanted, too.
  bool keeps_all;
};

/// What is found, a number for each pair, and room for kGridPadding more.
struct PairColumns {
  float* length;                      ///< [m]
  std::int32_t *from, *to, *between;  ///< angle_step of each angle's cosine; from < 0: left out
  std::int32_t* turn;                 ///< to the other end, in 256ths of a full turn; 256 is 0
  std::int32_t* position;             ///< of the other end
};

/// Over all points in the runs; how many there are.
std::size_t find_pairs(const geometry::OrientedColumns& points, const geometry::GridRun* runs,
                       std::size_t run_count, const PairStart& start, const PairColumns& found);

}  // namespace posevote::pairs
