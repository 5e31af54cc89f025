// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/data/cloud.hpp"

namespace posevote::pairs {

/// Few points that tell a surface's shape coarsely: for each cube of edge `edge` [m] one for each
/// direction that its normals have, 30 deg apart. One mean of all, as downsample_voxels has it,
/// would round off the edges of a box, where its pairs are. Directions that less than a sixth of a
/// cube's points have are noise and left out, points without a usable normal too. Nothing of
/// nothing. O(n log n).
Cloud thin_surface(const Cloud& cloud, float edge);

}  // namespace posevote::pairs
