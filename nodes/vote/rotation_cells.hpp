// SPDX-License-Identifier: BSD-3-Clause
// A grid over rotations: where a unit quaternion lies, and which part of the grid a ball of
// rotations can reach.
//
// The sphere of unit quaternions is cut like a cube map. The component k of largest magnitude
// chooses one of four charts (q and -q are one rotation, so q_k > 0), the other three divided by
// q_k lie in
// [-1, 1]^3. Each is warped so that cells are nearly equal in angle, v = u (4 - |u|) / 3, and cut
// into 256 levels. A grid of n <= 256 cells per axis is a coarsening of the levels, cell = level n
// / 256.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nodes/vote/kernel.hpp"

namespace posevote {

/// Chart and levels of one rotation, chart in the highest byte.
using RotationCode = std::uint32_t;

constexpr std::uint32_t kCharts = 4;
constexpr int kLevels = 256;

inline std::uint32_t chart_of(RotationCode code) { return code >> 24U; }

/// The codes of unit quaternions, the columns of which are `stride` apart: w, x, y, z. Up to
/// kScanPadding numbers behind the last are read and written.
void encode_rotations(const float* quaternions, std::size_t stride, std::size_t count,
                      RotationCode* codes);

/// The ball of rotations around a quaternion that a kernel can reach, as constants.
struct RotationReach {
  double sine;         ///< of half the angle, widened so that rounding cannot lose a neighbour
  double chart_limit;  ///< a chart is out of reach where the centre's component is below this
  int cells_per_axis;  ///< measured: finer grids cut rows too short for wide vectors
};

RotationReach make_rotation_reach(const Kernel& kernel, Bandwidth bandwidth);

/// A box of levels of one chart, borders included.
struct RotationBox {
  std::uint32_t chart = 0;
  std::array<std::uint32_t, 3> low{}, high{};
};

/// Boxes that together hold every rotation within reach of a vote, at most one per chart.
struct RotationBoxes {
  std::array<RotationBox, kCharts> items;
  std::size_t count = 0;
};

RotationBoxes rotation_boxes(const VotePoint& vote, const RotationReach& reach);

}  // namespace posevote
