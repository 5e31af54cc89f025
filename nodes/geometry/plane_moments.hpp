// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of plane fits: moments of the points around a place, as many at once as the
// processor allows. Sums run in sixteen lanes whatever its width, and never by fused multiply-adds:
// every processor gives the same bits.
#pragma once

#include <cstddef>

#include "nodes/geometry/grid_run.hpp"

namespace posevote::geometry {

/// Points as four arrays, with kGridPadding floats behind the last that may be read.
struct WeightedPoints {
  const float *x, *y, *z, *weight;
};

/// Sums over the points within a radius of a centre, offsets (x, y, z) in units of the radius: each
/// point counts by its own weight and by 1 - 0.999 times its squared distance. A little is left at
/// the rim: where all neighbours sit there, they still make a plane.
struct PlaneMoments {
  float xx, xy, xz, yy, yz, zz, x, y, z, one;
  float count;  ///< of points, unweighted
};

/// The moments of all points in the runs. `center`: x, y and z; `radius` > 0 [m].
PlaneMoments plane_moments(const WeightedPoints& points, const GridRun* runs, std::size_t run_count,
                           const float* center, float radius);

}  // namespace posevote::geometry
