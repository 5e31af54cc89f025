// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of for_each_facing. No header of Eigen here, as in grid_run.hpp.
#pragma once

#include <cstddef>

namespace posevote::geometry {

/// Points with normals, at most kCapacity of them, and what pose_and_face tells of them.
struct PointBatch {
  static constexpr std::size_t kCapacity = 64;

  alignas(64) float x[kCapacity] = {}, y[kCapacity] = {}, z[kCapacity] = {};
  alignas(64) float nx[kCapacity] = {}, ny[kCapacity] = {}, nz[kCapacity] = {};
  alignas(64) float cosine[kCapacity] = {};
};

/// Where points go, and who looks at them.
struct Posing {
  float rotation[3][3];  ///< columns
  float translation[3], viewpoint[3];
  float least_cosine;
  bool single_view;
};

/// Moves the first `count` points, and tells of each the cosine between its normal and the way to the
/// viewpoint: as ScanSurface::facing_cosine, to the last bit. What is behind them may change, too.
void pose_and_face(const Posing& posing, PointBatch& points, std::size_t count);

}  // namespace posevote::geometry
