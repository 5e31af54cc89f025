// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace posevote {

/// The turns that carry an object onto itself, all about one point: nobody can tell the poses apart
/// that differ by one of them. With one axis (a can) they are the turns below, each followed by any
/// turn about that axis; with two (a ball) they are all there are.
struct Symmetries {
  Eigen::Vector3f fixed_point = Eigen::Vector3f::Zero();  ///< in the model's own frame [m]
  std::vector<Eigen::Quaternionf> turns{Eigen::Quaternionf::Identity()};  ///< identity first
  std::vector<Eigen::Vector3f> axes;  ///< unit; of continuous symmetries

  bool any() const { return turns.size() > 1 || !axes.empty(); }
};

/// Another pose that a scan hardly tells from one that was found, for what differs between them is
/// small, and hidden or lost in noise.
struct LookAlike {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< T_scene_model motion is that pose
  double probability = 0;  ///< that it is the right one, given that the object lies there [0, 1]
};

}  // namespace posevote
