// SPDX-License-Identifier: BSD-3-Clause
// Industrial parts as CAD programs write them: at most 500 triangles, flat faces of two triangles.
// z is their axis, the length unit is a tenth of a metre; a seed varies their proportions by some
// per cent.
#pragma once

#include "nodes/data/cloud.hpp"
#include "tools/simulate/random.hpp"

namespace posevote::simulate {

Mesh can(Random& random);      ///< with a sunken lid: round about z
Mesh flange(Random& random);   ///< a disc with a hub, a bore and four holes: four-fold about z
Mesh bolt(Random& random);     ///< a hexagon head on a chamfered shaft: six-fold about z
Mesh bracket(Random& random);  ///< an L with one hole in the one leg and two in the other
Mesh gear(Random& random);     ///< twelve teeth, a hub on one side, a bore: twelve-fold about z
Mesh tee(Random& random);      ///< a pipe with a branch of the same width: two-fold about z
Mesh carton(Random& random);   ///< a box: two-fold about each axis
Mesh plate(Random& random);    ///< with four holes that no turn maps onto each other

}  // namespace posevote::simulate
