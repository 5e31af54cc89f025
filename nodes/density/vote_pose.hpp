// SPDX-License-Identifier: BSD-3-Clause
// From a vote to the pose it stands for. A vote stores where the model's *centre* c lands, t; the
// pose that carries model points into the scene is x -> R (x - c) + t.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "nodes/data/votes.hpp"

namespace posevote::density {

/// T_scene_model = (R, t - R c) of a rotation R and the place t where the model's centre c lands.
inline Eigen::Isometry3d vote_pose(const Eigen::Vector3f& center,
                                   const Eigen::Quaternionf& rotation,
                                   const Eigen::Vector3f& model_center) {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  T_scene_model.linear() = rotation.cast<double>().normalized().toRotationMatrix();
  T_scene_model.translation() =
      center.cast<double>() - T_scene_model.linear() * model_center.cast<double>();
  return T_scene_model;
}

/// T_scene_model of one vote of a set whose model is known.
inline Eigen::Isometry3d vote_pose(const VoteSet& votes, std::uint32_t vote) {
  const Eigen::Vector3f center(votes.tx[vote], votes.ty[vote], votes.tz[vote]);
  const Eigen::Quaternionf rotation(votes.qw[vote], votes.qx[vote], votes.qy[vote], votes.qz[vote]);
  return vote_pose(center, rotation, votes.model->center);
}

}  // namespace posevote::density
