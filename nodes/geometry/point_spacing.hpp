// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// The typical distance of a point to its nearest neighbour: the median over a sample [m]; 0 where
/// all points coincide. Parallel; linear in the points.
float point_spacing(const PointMatrix& points);

}  // namespace posevote::geometry
