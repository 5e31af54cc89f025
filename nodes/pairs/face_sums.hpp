// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of find_rims: the mean of the neighbours that belong to a point's face, as many at
// once as the processor allows. As plane_moments.hpp, in sixteen lanes: every processor gives the
// same bits.
#pragma once

#include <cstddef>

#include "nodes/geometry/grid_run.hpp"
#include "nodes/geometry/oriented_columns.hpp"

namespace posevote::pairs {

/// A point, and what belongs to its face.
struct Face {
  float point[3], normal[3];
  float radius;       ///< of its neighbours [m]
  float off_plane;    ///< how far above or below they may lie [m]
  float same_normal;  ///< cosine between normals that is exceeded
};

/// Of the neighbours' offsets from the point [m], and how many there are.
struct FaceSums {
  float x, y, z, count;
};

/// Over all points in the runs.
FaceSums face_sums(const geometry::OrientedColumns& points, const geometry::GridRun* runs,
                   std::size_t run_count, const Face& face);

}  // namespace posevote::pairs
