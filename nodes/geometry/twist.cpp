// SPDX-License-Identifier: BSD-3-Clause
// Equations after Sola, Deray, Atchuthan, A micro Lie theory for state estimation in robotics
// (2018), (172) to (174).
#include "nodes/geometry/twist.hpp"

#include <cmath>

namespace posevote::geometry {
namespace {

constexpr double kTiny = 1e-8;  // [rad]; below it the first terms of the series are exact

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

Vector6d log_motion(const Eigen::Isometry3d& motion) {
  const Eigen::AngleAxisd turn(motion.linear());  // angle in [0, pi]
  const Eigen::Matrix3d W = cross_matrix(turn.angle() * turn.axis());
  double second = 1.0 / 12;
  if (turn.angle() > kTiny) {
    const double half = turn.angle() / 2;
    second = (1 - half / std::tan(half)) / (turn.angle() * turn.angle());
  }
  Vector6d twist;
  twist << motion.translation() - W * motion.translation() / 2 +
               second * W * (W * motion.translation()),
      turn.angle() * turn.axis();
  return twist;
}

Eigen::Isometry3d exp_motion(const Vector6d& twist) {
  const Eigen::Vector3d shift = twist.head<3>(), turn = twist.tail<3>();
  const double angle = turn.norm();
  const Eigen::Matrix3d W = cross_matrix(turn);
  double first = 0.5, second = 1.0 / 6;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (angle > kTiny) {
    first = (1 - std::cos(angle)) / (angle * angle);
    second = (angle - std::sin(angle)) / (angle * angle * angle);
    motion.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  }
  motion.translation() = shift + first * W * shift + second * W * (W * shift);
  return motion;
}

}  // namespace posevote::geometry
