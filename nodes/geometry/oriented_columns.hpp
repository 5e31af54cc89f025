// SPDX-License-Identifier: BSD-3-Clause
// How vector kernels see points with normals. No header of Eigen here, as in grid_run.hpp.
#pragma once

namespace posevote::geometry {

/// Points and normals as six arrays in the order of a PointGrid, with kGridPadding floats behind the
/// last that may be read. A normal that is not a number: the point is no neighbour.
struct OrientedColumns {
  const float *x, *y, *z, *nx, *ny, *nz;
};

}  // namespace posevote::geometry
