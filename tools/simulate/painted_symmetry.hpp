// SPDX-License-Identifier: BSD-3-Clause
// Of the turns that leave a thing's shape as it was, those that leave its paint, too: none of a
// printed can, all of a cup of one colour.
#pragma once

#include "tools/simulate/paint.hpp"
#include "tools/simulate/shapes.hpp"

namespace posevote {

ShapeSymmetry painted_symmetry(const ShapeSymmetry& shape, const Mesh& mesh, const Paint& paint);

}  // namespace posevote
