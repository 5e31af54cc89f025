// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/pose_error.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <numeric>

#include "nodes/geometry/extreme_points.hpp"
#include "nodes/geometry/rotation.hpp"
#include "tools/evaluate/surface_points.hpp"

namespace posevote {

struct PoseMeter::Tree {
  nanoflann::KDTreeEigenMatrixAdaptor<PointMatrix, 3, nanoflann::metric_L2_Simple> points;

  explicit Tree(const PointMatrix& all) : points(3, std::cref(all)) {}

  double distance_to_nearest(const Eigen::Vector3d& from) const {
    const Eigen::Vector3f query = from.cast<float>();
    Eigen::Index nearest = 0;
    float squared = 0;
    points.query(query.data(), 1, &nearest, &squared);
    return std::sqrt(double{squared});
  }
};

namespace {

constexpr Eigen::Index kMostPoints = 1000;

/// What distances between surfaces are measured from and to. The vertices, as everybody does it;
/// but those of a CAD mesh leave its faces out, which a closest vertex may lie far from.
PointMatrix surface_of(const layouts::TrueObject& object) {
  constexpr Eigen::Index kDense = 20000;  // closest ones are within 1 % of the diameter
  if (object.points.rows() >= kMostPoints || object.faces.rows() == 0) return object.points;
  return surface_points(object.points, object.faces, kDense);
}

Eigen::Matrix3Xd sample_of(const PointMatrix& points, Eigen::Index most) {
  const Eigen::Index count = std::min(points.rows(), most);
  Eigen::Matrix3Xd sample(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    sample.col(i) = points.row(i * points.rows() / count).transpose().cast<double>();
  return sample;
}

double farthest(const Eigen::Matrix3Xd& points, const Eigen::Isometry3d& A,
                const Eigen::Isometry3d& B) {
  const Eigen::Matrix3d turn = A.linear() - B.linear();
  const Eigen::Vector3d shift = A.translation() - B.translation();
  return std::sqrt(((turn * points).colwise() + shift).colwise().squaredNorm().maxCoeff());
}

double farthest_in_image(const Eigen::Matrix3Xd& points, const Eigen::Isometry3d& A,
                         const Eigen::Isometry3d& B, const Camera& camera) {
  double most = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d a = A * points.col(i), b = B * points.col(i);
    if (!(a.z() > 0) || !(b.z() > 0)) return kBeyond;
    const double u = camera.fx * (a.x() / a.z() - b.x() / b.z());
    const double v = camera.fy * (a.y() / a.z() - b.y() / b.z());
    most = std::max(most, u * u + v * v);
  }
  return std::sqrt(most);
}

constexpr double kStep = 0.02;  // of turns about an axis [rad]

Eigen::Isometry3d turn_about(const layouts::SymmetryAxis& axis, double angle) {
  return Eigen::Translation3d(axis.offset) * Eigen::AngleAxisd(angle, axis.direction) *
         Eigen::Translation3d(-axis.offset);
}

/// The least of a measure that grows with the square of the turn from its least, where that lies
/// within half a step of no turn; `here`: of no turn.
template <class Measure>
double least_between_steps(double here, const layouts::SymmetryAxis& axis, const Measure& measure) {
  const double before = measure(turn_about(axis, -kStep / 2));
  const double behind = measure(turn_about(axis, kStep / 2));
  const double bend = before + behind - 2 * here;
  if (!(bend > 0)) return std::min(before, behind);
  const double angle = kStep / 4 * (before - behind) / bend;
  return measure(turn_about(axis, std::clamp(angle, -kStep / 2, kStep / 2)));
}

}  // namespace

std::vector<Eigen::Isometry3d> symmetry_steps(const layouts::TrueObject& object) {
  std::vector<Eigen::Isometry3d> turns{Eigen::Isometry3d::Identity()};
  const int count = static_cast<int>(std::ceil(2 * M_PI / kStep));
  for (const layouts::SymmetryAxis& axis : object.axes)
    for (int i = 1; i < count; ++i) turns.push_back(turn_about(axis, 2 * M_PI * i / count));
  std::vector<Eigen::Isometry3d> steps;
  for (const Eigen::Isometry3d& symmetry : object.symmetries)
    for (const Eigen::Isometry3d& turn : turns) steps.push_back(turn * symmetry);
  return steps;
}

PoseMeter::PoseMeter(const layouts::TrueObject& object)
    : object_(&object),
      surface_(surface_of(object)),
      sample_(sample_of(surface_, kMostPoints)),
      extreme_(geometry::extreme_points(object.points)),
      all_(object.points.transpose().cast<double>()),
      steps_(symmetry_steps(object)),
      tree_(std::make_shared<const Tree>(surface_)) {}

double PoseMeter::center(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const {
  return (T_true * object_->center - T_found * object_->center).norm();
}

double PoseMeter::rotation(const Eigen::Isometry3d& T_true,
                           const Eigen::Isometry3d& T_found) const {
  double least = kBeyond;
  for (const Eigen::Isometry3d& symmetry : object_->symmetries) {
    const Eigen::Matrix3d R = T_true.linear() * symmetry.linear();
    if (object_->axes.empty())
      least = std::min(least, geometry::angle_between(R, T_found.linear()));
    for (const layouts::SymmetryAxis& axis : object_->axes) {
      const Eigen::Vector3d a = R * axis.direction, b = T_found.linear() * axis.direction;
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return least;
}

double PoseMeter::add(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const {
  if (object_->symmetric()) return adds(T_true, T_found);
  if (center(T_true, T_found) > object_->diameter) return kBeyond;
  return (T_true * sample_ - T_found * sample_).colwise().norm().mean();
}

double PoseMeter::adds(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const {
  if (center(T_true, T_found) > object_->diameter) return kBeyond;
  const Eigen::Isometry3d T_found_true = T_found.inverse() * T_true;
  double sum = 0;
  for (Eigen::Index i = 0; i < sample_.cols(); ++i)
    sum += tree_->distance_to_nearest(T_found_true * sample_.col(i));
  return sum / static_cast<double>(sample_.cols());
}

/// The extreme points bound the distance over all points from below; so few symmetries need all
/// points, and the result is that of all.
template <class Measure>
double PoseMeter::least_over_symmetries(const Measure& measure) const {
  std::vector<double> bounds;
  for (const Eigen::Isometry3d& step : steps_) bounds.push_back(measure(extreme_, step));
  std::vector<std::size_t> order(steps_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return bounds[a] < bounds[b]; });
  double least = kBeyond;
  for (const std::size_t i : order) {
    if (bounds[i] >= least) break;
    least = std::min(least, measure(all_, steps_[i]));
  }
  return least;
}

double PoseMeter::mssd(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const {
  if (center(T_true, T_found) > object_->diameter) return kBeyond;
  return least_over_symmetries([&](const Eigen::Matrix3Xd& points, const Eigen::Isometry3d& step) {
    return farthest(points, T_true * step, T_found);
  });
}

double PoseMeter::surprise(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found,
                           const geometry::Matrix6d& covariance) const {
  const Eigen::LLT<geometry::Matrix6d> factor(covariance);
  if (!covariance.allFinite() || factor.info() != Eigen::Success) return kUnknown;
  const Eigen::Isometry3d T_found_true = T_found.inverse() * T_true;
  const auto squared = [&](const Eigen::Isometry3d& symmetry) {
    return factor.matrixL().solve(geometry::log_motion(T_found_true * symmetry)).squaredNorm();
  };
  double least = kBeyond;
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  for (const Eigen::Isometry3d& step : steps_)
    if (const double value = squared(step); value < least) least = value, best = step;
  for (const layouts::SymmetryAxis& axis : object_->axes)
    least = std::min(least, least_between_steps(least, axis, [&](const Eigen::Isometry3d& turn) {
                       return squared(turn * best);
                     }));
  return least;
}

double PoseMeter::mspd(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found,
                       const Camera& camera) const {
  return least_over_symmetries([&](const Eigen::Matrix3Xd& points, const Eigen::Isometry3d& step) {
    return farthest_in_image(points, T_true * step, T_found, camera);
  });
}

}  // namespace posevote
