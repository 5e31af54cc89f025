// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/rotation.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace posevote::geometry {

Eigen::Isometry3d make_pose(const std::array<double, 9>& rotation,
                            const Eigen::Vector3d& translation) {
  Eigen::Matrix3d matrix;
  matrix << rotation[0], rotation[1], rotation[2], rotation[3], rotation[4], rotation[5],
      rotation[6], rotation[7], rotation[8];
  if (!matrix.allFinite() || !translation.allFinite())
    throw std::invalid_argument("a pose must be of finite numbers");
  const Eigen::Matrix3d rest = matrix * matrix.transpose() - Eigen::Matrix3d::Identity();
  if (rest.cwiseAbs().maxCoeff() > 1e-2 || matrix.determinant() < 0)
    throw std::invalid_argument("R is no rotation");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(matrix).normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

Eigen::Isometry3d turn_about(const Eigen::Vector3d& point, const Eigen::Quaterniond& turn) {
  return Eigen::Translation3d(point) * turn * Eigen::Translation3d(-point);
}

Eigen::Vector3d point_on_axis(const Eigen::Isometry3d& motion) {
  const Eigen::Vector3d axis = Eigen::AngleAxisd(motion.linear()).axis();
  const Eigen::Vector3d across = motion.translation() - axis.dot(motion.translation()) * axis;
  const Eigen::Matrix3d moved = Eigen::Matrix3d::Identity() - motion.linear();
  return moved.completeOrthogonalDecomposition().solve(across);
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::Matrix3d relative = a.transpose() * b;
  const Eigen::Quaterniond q(relative);
  return 2 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

double angle_between_axes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

}  // namespace posevote::geometry
