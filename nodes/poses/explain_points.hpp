// SPDX-License-Identifier: BSD-3-Clause
// Which scan points a posed model explains: those near its surface whose normals are not opposed to
// it. Explained points leave the scan, and the correspondences that start at them leave every
// object's votes (paper, section 4: "segment out the scene data containing the object instance").
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/near_surface.hpp"

namespace posevote::poses {

/// Per row of `points`: 1 if a point of `model` lies within `distance` [m] once the model is posed,
/// and their normals are less than 90 deg apart. `model_index` holds the model's points.
std::vector<char> explain_points(const Cloud& model, const geometry::SurfaceIndex& model_index,
                                 const Eigen::Isometry3d& T_scene_model, const PointMatrix& points,
                                 const PointMatrix& normals, float distance);

}  // namespace posevote::poses
