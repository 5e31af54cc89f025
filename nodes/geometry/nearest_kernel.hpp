// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of NearestIndex. No header of Eigen here, as in grid_run.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/geometry/grid_run.hpp"

namespace posevote::geometry {

/// Points as three arrays, with kGridPadding floats behind the last that may be read; one that has
/// a coordinate that is not a number is never found.
struct PointColumns {
  const float *x, *y, *z;
  const std::uint32_t* index;  ///< the point's own number
};

/// The nearest of all points in some runs; what lies behind a run's end may be found, too.
struct NearestPoint {
  std::uint32_t index = 0xFFFFFFFF;  ///< that number if none
  float squared = 0;                 ///< distance [m^2]
};

/// At most the square root of `farthest` away; of several at one distance the one with the smallest
/// index.
NearestPoint nearest_in_runs(const PointColumns& points, const GridRun* runs, std::size_t run_count,
                             const float* center, float farthest);

}  // namespace posevote::geometry
