// SPDX-License-Identifier: BSD-3-Clause
// Which poses are the same to somebody who looks: near, and turned alike but for what the object's
// symmetries allow.
#pragma once

#include <vector>

#include "nodes/data/hypotheses.hpp"
#include "nodes/data/model.hpp"

namespace posevote::explain {

/// A pose and those that look the same; of an axis a turn every 15 deg.
class Alike {
 public:
  Alike(const Model& model, const Eigen::Isometry3d& T_scene_model);

  const std::vector<Eigen::Isometry3d>& poses() const { return poses_; }
  /// Whether a pose is within a tenth of the object's diagonal, by its centre, and 30 deg.
  bool is_near(const Eigen::Isometry3d& T_scene_model) const;
  bool is_near(const Hypothesis& pose) const;
  /// How far a pose's centre and turn are off [m], [rad]; the turn to the nearest that looks alike.
  double distance(const Eigen::Isometry3d& T_scene_model) const;
  double turn(const Eigen::Isometry3d& T_scene_model) const;

 private:
  Eigen::Vector3f center_;
  double diagonal_;
  std::vector<Eigen::Isometry3d> poses_;  ///< the first is the pose itself
};

}  // namespace posevote::explain
