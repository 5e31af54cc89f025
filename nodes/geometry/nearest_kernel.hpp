// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of NearestIndex. No header of Eigen here, as in grid_run.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/geometry/grid_run.hpp"

namespace posevote::geometry {

constexpr std::size_t kGroup = 8;  ///< points

/// Points that lie together in memory, two lines of it: most runs touch no more than two groups. A
/// point that has an infinite coordinate is never found.
struct alignas(128) PointGroup {
  float x[kGroup], y[kGroup], z[kGroup];
  std::uint32_t index[kGroup];  ///< the point's own number
};

/// A point near a place, or none. In a register: std::optional would take twelve bytes.
struct NearestPoint {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::uint32_t index = kNone;
  float squared = 0;  ///< distance [m^2]

  explicit operator bool() const { return index != kNone; }
};

/// The nearest of all points in some runs, at most the square root of `farthest`, a finite number,
/// away; of several at one distance the one with the smallest index. Those that share a group with a
/// run may be found, too.
NearestPoint nearest_in_runs(const PointGroup* groups, const GridRun* runs, std::size_t run_count,
                             const float* center, float farthest);

}  // namespace posevote::geometry
