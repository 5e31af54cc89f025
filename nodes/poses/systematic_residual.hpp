// SPDX-License-Identifier: BSD-3-Clause
// How far patches of the scan lie off the surface of a posed model. Asked of the scan's points: the
// point of the scan that is nearest to one of the model is, among many that noise has scattered, one
// that errs little, so that a marker that was put along the edge of a box, where noise is thicker
// than points are apart, seems to lie on it.
#pragma once

#include <Eigen/Geometry>

#include "nodes/poses/patches.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// Points that are farther from the model's do not count, x tolerance.
constexpr float kFarOff = 1.5F;

/// What the heights of neighbours over the model's surface have in common, of the points that
/// nothing explained yet and that are turned as that is; 0 where there are none. Takes a
/// search for each point, of at most about `points`.
Shared systematic_residual(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                           Eigen::Index points);

}  // namespace posevote::poses
