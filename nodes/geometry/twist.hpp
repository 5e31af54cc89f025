// SPDX-License-Identifier: BSD-3-Clause
// Small motions as six numbers.
#pragma once

#include <Eigen/Geometry>

namespace posevote::geometry {

/// A translation [m], then a turn, as a rotation vector [rad]: the twist whose exponential a motion
/// is. In a covariance, rows and columns come in this order.
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The logarithm on SE(3). Of the two rotation vectors of half a turn, one.
Vector6d log_motion(const Eigen::Isometry3d& motion);

/// Its inverse, the exponential.
Eigen::Isometry3d exp_motion(const Vector6d& twist);

}  // namespace posevote::geometry
