// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// The outermost points in some 500 directions, each once: nearly the corners of the convex hull,
/// where the largest distances are.
Eigen::Matrix3Xd extreme_points(const PointMatrix& points);

/// The largest distance between two of them [m].
double diameter_of(const PointMatrix& points);

}  // namespace posevote::geometry
