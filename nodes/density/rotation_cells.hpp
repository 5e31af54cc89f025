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

#include "nodes/density/kernel.hpp"

namespace posevote::density {

/// Chart and levels of one rotation, chart in the highest byte.
using RotationCode = std::uint32_t;

constexpr std::uint32_t kCharts = 4;
constexpr int kLevels = 256;

inline std::uint32_t chart_of(RotationCode code) { return code >> 24U; }

/// The codes of unit quaternions: w, x, y, z. Numbers that are no unit quaternion give some code.
void encode_rotations(const std::array<const float*, 4>& quaternions, std::size_t count,
                      RotationCode* codes);

/// Codes of rotations near each other give numbers near each other; below 2^11.
inline std::uint32_t rotation_order(RotationCode code) {
  // The three highest bits of each level, interleaved.
  const auto spread = [code](unsigned shift) {
    constexpr std::array<std::uint32_t, 8> kSpread{0, 1, 8, 9, 64, 65, 72, 73};
    return kSpread[(code >> shift) & 7U];
  };
  return chart_of(code) << 9U | spread(21) << 2U | spread(13) << 1U | spread(5);
}

/// All rotations within an angle of a quaternion.
struct RotationBall {
  std::array<double, 4> center;  ///< w, x, y, z, unit
  double cosine;                 ///< of half the angle
};

/// A ball that holds every rotation that the kernel can reach from any of these votes.
RotationBall reach_of(const Kernel& kernel, const VotePoint* votes, std::size_t count);

/// A box of levels of one chart, borders included.
struct RotationBox {
  std::uint32_t chart = 0;
  std::array<std::uint32_t, 3> low{}, high{};
};

/// Boxes that together hold every rotation of a ball, at most one per chart.
struct RotationBoxes {
  std::array<RotationBox, kCharts> items;
  std::size_t count = 0;
};

RotationBoxes rotation_boxes(const RotationBall& ball);

/// Cells per axis beyond which rows of cells get too short for wide vectors: measured.
std::uint32_t finest_rotation_cells(Bandwidth bandwidth);

}  // namespace posevote::density
