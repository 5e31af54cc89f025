// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// How to find the normals of a whole body.
struct OutwardNormals {
  std::string source = "auto";  ///< faces; pca: neighbourhoods; auto: faces where there are any
  float radius = 0;             ///< smallest neighbourhood [m]; it spans at least three of the
                                ///< points' own spacings, and more where the points are noisy
  int min_neighbours = 5;       ///< fewer points in a neighbourhood give no normal
};

/// The outward normal at every point of a body's whole surface, (0, 0, 0) where there is none: in
/// no face, alone, on a line.
///
/// A mesh: area-weighted from its faces, wound outward (winding.hpp). A raw cloud: planes through
/// the neighbours (plane_normals.hpp), signs by a traversal from the outermost point
/// (orient_outward.hpp). Normals that the body has are not looked at. O(n log n).
PointMatrix outward_normals(const Mesh& body, const OutwardNormals& how);

}  // namespace posevote::geometry
