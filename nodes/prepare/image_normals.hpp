// SPDX-License-Identifier: BSD-3-Clause
// Normals of a depth image. The neighbours of a point are pixels around it, so no search is needed:
// a quarter of the time that plane_normals.hpp takes for the same planes.
#pragma once

#include <optional>

#include "nodes/data/cloud.hpp"

namespace posevote::prepare {

/// The normal at every point of a depth image, by planes of a radius as suitable_planes would
/// choose it; sign arbitrary, (0, 0, 0) where there is none. Blocks of 2 x 2 pixels share a plane
/// where they are on one surface; smooth ground has planes every four pixels and mixes them
/// between. Parallel. None where the cloud is no depth image or its pixels are so fine that merging
/// them first is faster.
std::optional<PointMatrix> image_normals(const Scan& scan, float smallest, float spacings,
                                         int min_neighbours);

}  // namespace posevote::prepare
