// SPDX-License-Identifier: BSD-3-Clause
// How vector kernels add up: in so many lanes, whatever the processor's width, and these always in
// the same order, on which the bits of sums hang.
#pragma once

#include <cstddef>

#include "nodes/geometry/grid_run.hpp"

namespace posevote::geometry {

inline constexpr std::size_t kLanes = 16;
static_assert(kLanes <= kGridPadding);

/// The sum of kLanes floats, which it changes.
inline float sum_of_lanes(float* lanes) {
  for (std::size_t half = kLanes / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  return lanes[0];
}

}  // namespace posevote::geometry
