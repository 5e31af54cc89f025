// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/pose_error.hpp"

#include <cmath>
#include <limits>

#include "tools/evaluate/rotation.hpp"

namespace posevote {
namespace {

constexpr Eigen::Index kMostPoints = 1000;

Eigen::Matrix3Xd sample_of(const PointMatrix& points) {
  const Eigen::Index count = std::min(points.rows(), kMostPoints);
  Eigen::Matrix3Xd sample(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    sample.col(i) = points.row(i * points.rows() / count).transpose().cast<double>();
  return sample;
}

/// Distance to the nearest point, found in growing balls.
double nearest_distance(const PointGrid& grid, const Eigen::Vector3d& point, double diameter) {
  for (const double radius : {0.03, 0.1, 0.3, 1.0, 5.0})
    if (const auto near = grid.nearest(point.cast<float>(), static_cast<float>(radius * diameter)))
      return std::sqrt(double{near->squared});
  return std::numeric_limits<double>::infinity();
}

}  // namespace

PoseMeter::PoseMeter(const TrueObject& object)
    : object_(&object),
      sample_(sample_of(object.points)),
      grid_(object.points, static_cast<float>(object.diameter / 15)) {}

PoseError PoseMeter::measure(const Eigen::Isometry3d& T_true,
                             const Eigen::Isometry3d& T_found) const {
  PoseError error;
  error.center = (T_true * object_->center - T_found * object_->center).norm();
  error.rotation = rotation_error(T_true.linear(), T_found.linear());
  if (error.center > object_->diameter)
    error.add = std::numeric_limits<double>::infinity();
  else
    error.add = object_->symmetric() ? adi(T_true, T_found) : add(T_true, T_found);
  return error;
}

double PoseMeter::add(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const {
  return (T_true * sample_ - T_found * sample_).colwise().norm().mean();
}

double PoseMeter::adi(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const {
  const Eigen::Isometry3d T_found_true = T_found.inverse() * T_true;
  double sum = 0;
  for (Eigen::Index i = 0; i < sample_.cols(); ++i)
    sum += nearest_distance(grid_, T_found_true * sample_.col(i), object_->diameter);
  return sum / static_cast<double>(sample_.cols());
}

double PoseMeter::rotation_error(const Eigen::Matrix3d& R_true,
                                 const Eigen::Matrix3d& R_found) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& symmetry : object_->symmetries) {
    const Eigen::Matrix3d R = R_true * symmetry.linear();
    if (object_->axes.empty()) least = std::min(least, angle_between(R, R_found));
    for (const Eigen::Vector3d& axis : object_->axes) {
      const Eigen::Vector3d a = R * axis, b = R_found * axis;
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return least;
}

}  // namespace posevote
