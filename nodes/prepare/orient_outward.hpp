// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/data/cloud.hpp"
#include "nodes/prepare/grid.hpp"

namespace posevote {

/// Gives the plane normals of a closed surface's raw cloud consistent signs, outward.
///
/// A traversal of the graph of neighbours within `radius` [m] carries the sign from point to point,
/// always along the edge between the most parallel normals next (Hoppe et al. 1992), so that it
/// crosses sharp edges last. In each connected part it starts at the point farthest from the part's
/// centroid, where the surface must face away. Points without a normal are passed over. O(E log E).
void orient_outward(const PointMatrix& points, const PointGrid& grid, float radius,
                    PointMatrix& normals);

}  // namespace posevote
