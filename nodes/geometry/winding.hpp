// SPDX-License-Identifier: BSD-3-Clause
// Makes the faces of a mesh agree on which side is outside.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Faces that hang together by edges which exactly two of them share.
struct SurfacePart {
  std::vector<std::uint32_t> faces;
  bool closed = false;  ///< every edge is shared
};

using Edge = std::array<std::uint32_t, 2>;  ///< the points at its ends

struct WoundFaces {
  FaceMatrix faces;
  std::vector<SurfacePart> parts;
  std::vector<Edge> open_edges;  ///< of one face alone: there the mesh ends
};

/// Faces wound so that their normals point outward, as far as that can be told from them alone.
///
/// Neighbouring faces are made to agree by a breadth-first walk over the edges that exactly two
/// faces share; points in one place count as one, so a texture's seams do not divide a surface.
/// Then each connected component is turned by its own signed volume, taken about its own centroid
/// so that an open shell, too, has a sensible one. A component inside the bounding box of the
/// largest one may be the wall of a cavity, for which the sign is the other way around: it keeps
/// the orientation relative to the largest that most of its area has in the file. So does a flat
/// one, which has no volume; where the largest is flat, the file is right. Degenerate faces and copies of a face are left out. Throws
/// std::runtime_error if a face has a corner that is no point. O(n log n).
WoundFaces wind_parts(const PointMatrix& points, const FaceMatrix& faces);

/// The faces alone.
FaceMatrix wind_outward(const PointMatrix& points, const FaceMatrix& faces);

}  // namespace posevote::geometry
