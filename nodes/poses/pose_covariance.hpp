// SPDX-License-Identifier: BSD-3-Clause
// How far a refined pose may be off. README.md in this folder derives it and says how it was
// checked.
#pragma once

#include <optional>

#include "nodes/geometry/twist.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// The covariance of the pose error xi, a twist in the model's frame, about its origin, translation
/// [m] before turn [rad]: T_true = T_scene_model exp(xi). About the origin, and not the centre, so
/// that the equation holds as it stands, with nothing but what is in the file. Of a pose that ICP
/// has brought to its end, by the scan as it is now. A direction that nothing holds has the variance
/// of who knows nothing (terms.hpp). Empty-handed where too few points hold the pose, or none was
/// refined. Cost: as a step of ICP.
std::optional<geometry::Matrix6d> pose_covariance(const Sought& sought,
                                                  const Eigen::Isometry3d& T_scene_model);

}  // namespace posevote::poses
