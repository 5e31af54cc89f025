// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

namespace posevote::geometry {

/// Makes a pose of 9 numbers, row by row, and a translation. Throws std::invalid_argument where
/// the numbers are not finite or no rotation (to 1e-2: published files are rounded); an equal or
/// near rotation is taken.
Eigen::Isometry3d make_pose(const std::array<double, 9>& rotation,
                            const Eigen::Vector3d& translation);

/// `turn` (unit) about a point that stays where it is.
Eigen::Isometry3d turn_about(const Eigen::Vector3d& point, const Eigen::Quaterniond& turn);

/// The point nearest to the origin on the axis about which a motion turns; any slide along it aside.
Eigen::Vector3d point_on_axis(const Eigen::Isometry3d& motion);

/// Angle of the rotation that carries a into b, in [0, pi]; also right for tiny angles.
double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

/// Angle between two unit vectors, in [0, pi].
double angle_between_axes(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace posevote::geometry
