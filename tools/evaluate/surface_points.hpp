// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/data/cloud.hpp"

namespace posevote {

/// `count` points spread evenly over the faces, by area, the same ones each time [m]. Needs a face
/// that has an area.
PointMatrix surface_points(const PointMatrix& points, const FaceMatrix& faces, Eigen::Index count);

}  // namespace posevote
