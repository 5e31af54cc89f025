// SPDX-License-Identifier: BSD-3-Clause
// Fields of things that people buy and use: smooth, thin-walled or symmetric, where the other
// shapes are rich. Longest side about 2, z up; a seed varies their proportions.
#pragma once

#include "tools/simulate/random.hpp"
#include "tools/simulate/surface_nets.hpp"

namespace posevote::simulate {

Field cup(Random& random);       ///< of paper, open, without a handle: round about z
Field juice(Random& random);     ///< a small carton with a folded top and a cap
Field milk(Random& random);      ///< a gable-top carton with a screw cap
Field shampoo(Random& random);   ///< an oval bottle with shoulders and a cap
Field joystick(Random& random);  ///< a leaning stick with a head on a base with buttons
Field camera(Random& random);    ///< a box with a lens, a grip and a viewfinder

}  // namespace posevote::simulate
