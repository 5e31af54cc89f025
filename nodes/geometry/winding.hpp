// SPDX-License-Identifier: BSD-3-Clause
// Makes the faces of a mesh agree on which side is outside.
#pragma once

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Faces wound so that their normals point outward.
///
/// Neighbouring faces are made to agree by a breadth-first walk over the edges that exactly two
/// faces share; points in one place count as one, so a texture's seams do not divide a surface.
/// Then each connected component is turned by its own signed volume, taken about its own centroid
/// so that an open shell, too, has a sensible one. A component inside the bounding box of the
/// largest one may be the wall of a cavity, for which the sign is the other way around: it keeps
/// the orientation relative to the largest that most of its area has in the file. So does a flat
/// one, which has no volume. Degenerate faces and copies of a face are left out. Throws
/// std::runtime_error if a face has a corner that is no point. O(n log n).
FaceMatrix wind_outward(const PointMatrix& points, const FaceMatrix& faces);

}  // namespace posevote::geometry
