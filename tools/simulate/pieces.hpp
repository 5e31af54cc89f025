// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// A body as points whose convex hulls, piece by piece, are about the body.
struct Pieces {
  PointMatrix points;                         ///< [m]
  std::vector<std::set<std::uint32_t>> list;  ///< the points of each piece
};

/// Cuts a closed mesh up by cubes a sixth of its longest side wide: the corners of the triangles in
/// each. Coarse triangles are cut small before; and since flat patches of them have no thickness,
/// points inside of the body join them.
Pieces cut_up(const Mesh& mesh);

}  // namespace posevote
