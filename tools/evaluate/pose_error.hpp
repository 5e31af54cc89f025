// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/prepare/grid.hpp"
#include "tools/evaluate/ground_truth.hpp"

namespace posevote {

/// How far a found pose is from a true one.
struct PoseError {
  double center = 0;    ///< distance of the model centres [m]
  double rotation = 0;  ///< [rad]; the smallest over the object's symmetries
  double add = 0;       ///< ADD, for symmetric objects ADI [m]; infinity where the centres are
                        ///< more than a diameter apart
};

/// Measures the poses of one object (Hinterstoisser 2012: ADD is the mean distance between a model
/// point in one pose and the same point in the other; ADI, the closest point in the other). At most
/// 1000 model points are measured, evenly taken from the file.
class PoseMeter {
 public:
  explicit PoseMeter(const TrueObject& object);
  PoseError measure(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;

 private:
  double add(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;
  double adi(const Eigen::Isometry3d& T_true, const Eigen::Isometry3d& T_found) const;
  double rotation_error(const Eigen::Matrix3d& R_true, const Eigen::Matrix3d& R_found) const;

  const TrueObject* object_;
  Eigen::Matrix3Xd sample_;
  PointGrid grid_;
};

}  // namespace posevote
