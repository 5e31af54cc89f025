// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/formats/raw_mesh.hpp"

namespace posevote::formats {

/// Cuts the concave polygons of a mesh anew, by clipping ears (Meisters 1975): their fans of
/// triangles reach beyond them. The fans of all others stay as they are, and so do those of
/// polygons that have no ears because they cross themselves, that hold points that are not finite,
/// or that have more than 1000 corners (an honest file has some ten; the time grows with their
/// cube).
void mend_concave(RawMesh& mesh);

}  // namespace posevote::formats
