// SPDX-License-Identifier: BSD-3-Clause
// Poses of one instance in the frames of a stream, held steady: a Kalman filter for what stands still,
// which gives up its past as soon as the instance moves. What frames differ by is mostly noise of the
// sensor, and averages out; what moves is not to lag behind.
#pragma once

#include <optional>

#include "nodes/geometry/twist.hpp"

namespace posevote::poses {

/// A pose, and how far it may be off: a covariance as poses/pose_covariance.hpp has it.
struct UncertainPose {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Identity();
};

struct SteadyTerms {
  double drift = 0.05;    ///< x covariance of what is measured: how far it moves unnoticed
  double still = 12.592;  ///< chi-square of six degrees of freedom, 95 %: more is a motion
};

/// The pose after `measured`, of an instance that was thought to be at `before`; `measured` itself
/// where that is elsewhere than noise would have it.
UncertainPose steady(const UncertainPose& before, const UncertainPose& measured,
                     const SteadyTerms& terms);

}  // namespace posevote::poses
