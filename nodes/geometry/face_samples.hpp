// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Oriented points on the faces of a mesh.
struct FaceSamples {
  PointMatrix points;                ///< n x 3 [m]
  PointMatrix normals;               ///< n x 3 unit vectors, on the side that the winding says
  std::vector<std::uint32_t> faces;  ///< the face that each lies on, ascending
  PointMatrix weights{};             ///< n x 3, of that face's corners: where on it
};

/// Points spread evenly over the area of all faces, one for each `spacing` squared [m^2] but at
/// most `most`; the order of the faces decides where, nothing else.
///
/// Every n-th part of the area gets its point. Where in its face follows the R2 sequence (Roberts,
/// "The Unreasonable Effectiveness of Quasirandom Sequences", 2018), so a large face is covered
/// without gaps or heaps however long and thin it is. The normal is interpolated between those of
/// the corners, which are the area-weighted means over the faces there that differ from this one by
/// less than `crease` [rad]: a fine mesh of a curved surface is smooth, a box keeps its edges. 0:
/// the faces' own.
///
/// Throws std::runtime_error where a corner is no point or the faces have no area. O(n).
FaceSamples sample_faces(const PointMatrix& points, const FaceMatrix& faces, double spacing,
                         double crease, std::size_t most);

}  // namespace posevote::geometry
