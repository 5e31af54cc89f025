// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/twist.hpp"
#include "nodes/layouts/ground_truth.hpp"

namespace posevote {

/// Errors of a pair that were not asked for, or cannot be measured.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// An error beyond every threshold.
inline constexpr double kBeyond = std::numeric_limits<double>::infinity();

/// The object turned onto itself: discrete symmetries times continuous ones, these in 315 steps (no
/// point travels more than 1 % of the diameter in one, as in BOP). The identity is among them.
std::vector<Eigen::Isometry3d> symmetry_steps(const layouts::TrueObject& object);

/// Measures the poses of one object. Needs the object to live as long. Threads may share it.
class PoseMeter {
 public:
  explicit PoseMeter(const layouts::TrueObject& object);

  /// Distance of the model centres [m].
  double center(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;
  /// The smallest rotation over the symmetries [rad].
  double rotation(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;
  /// ADD: mean distance between a model point in one pose and the same point in the other; for
  /// symmetric objects `adds` [m]. At most 1000 model points are measured, evenly taken: vertices,
  /// or, of a mesh that has fewer, points of its faces. kBeyond where centres are a diameter apart.
  double add(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;
  /// ADD-S, which is ADI: mean distance of a model point in the true pose to the closest point in
  /// the other (Hinterstoisser 2012; Xiang 2018), of whatever object [m]. As above.
  double adds(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;
  /// BOP's maximum symmetry-aware surface distance [m]; kBeyond as above.
  double mssd(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;
  /// The squared Mahalanobis distance of the pose error, T_true = T_found exp(xi): xi' C^-1 xi, the
  /// smallest over the symmetries. Of errors that are as `covariance` says it is chi-square
  /// distributed with six degrees of freedom. kUnknown of what is no covariance.
  double surprise(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found,
                  const geometry::Matrix6d& covariance) const;
  /// BOP's maximum symmetry-aware projection distance [pixel]; kBeyond where a model point lies
  /// behind the camera.
  double mspd(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found,
              const Camera& camera) const;

 private:
  struct Tree;  // k-d tree of all points that stand for the surface (nanoflann)

  template <class Measure>
  double least_over_symmetries(const Measure& measure) const;

  const layouts::TrueObject* object_;
  PointMatrix surface_;  ///< vertices, or points of few large faces
  Eigen::Matrix3Xd sample_, extreme_, all_;
  std::vector<Eigen::Isometry3d> steps_;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace posevote
