// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tools/simulate/scene.hpp"

namespace posevote {

/// Drops bodies one after another, in random orientations, over a disc of `radius` around the
/// origin onto the plane z = 0 and each other, and lets them come to rest (rigid bodies; Bullet, in
/// single precision). Sets their poses. With `walls`, none leaves the square of half side `radius`.
///
/// Each body is the convex hulls of pieces of its surface, a sixth of its longest side wide, so
/// dents smaller than that are filled and bodies may come to rest a millimetre or two apart.
/// The same arguments give the same poses on one machine.
void settle(std::vector<Body>& bodies, double radius, bool walls, Random& random);

}  // namespace posevote
