// SPDX-License-Identifier: BSD-3-Clause
// Household objects made of simple shapes, z up; with parts.hpp's can and carton those of the YCB
// set (Calli 2015), whose sizes a spec gives. Few triangles, as CAD programs write them.
#pragma once

#include "nodes/data/cloud.hpp"
#include "tools/simulate/random.hpp"

namespace posevote::simulate {

Mesh tin(Random& random);       ///< with rounded corners and a sunken lid: two-fold about z
Mesh bottle(Random& random);    ///< round, with shoulders and a cap: flattened by its sides
Mesh bowl(Random& random);      ///< open: round about z
Mesh mug(Random& random);       ///< with a handle, whose ends stick in the wall
Mesh pitcher(Random& random);   ///< a tall mug with a wide handle
Mesh banana(Random& random);    ///< a bent tube with a stalk
Mesh drill(Random& random);     ///< an outline with a muzzle, a grip and a foot
Mesh scissors(Random& random);  ///< a flat outline with two finger holes
Mesh marker(Random& random);    ///< a rod with a thicker cap: round about z
Mesh clamp(Random& random);     ///< a flat outline of two jaws and two handles

}  // namespace posevote::simulate
