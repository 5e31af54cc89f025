// SPDX-License-Identifier: BSD-3-Clause
// Makes the faces of a mesh agree on which side is outside.
#pragma once

#include "nodes/data/cloud.hpp"

namespace posevote {

/// Faces wound so that their normals point outward.
///
/// Neighbouring faces are made to agree by a breadth-first walk over the edges that exactly two
/// faces share. If they agreed already, the mesh is turned as a whole by its signed volume: then
/// the inner wall of a hollow object keeps its orientation relative to the outer one. Else each
/// connected component is turned by its own signed volume. Volumes are taken about the
/// (component's) centroid, so that an open shell, too, has a sensible one. Degenerate faces (two
/// equal corners) are left out.
FaceMatrix wind_outward(const PointMatrix& points, const FaceMatrix& faces);

}  // namespace posevote
