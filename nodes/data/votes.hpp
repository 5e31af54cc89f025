// SPDX-License-Identifier: BSD-3-Clause
// Pose votes of one object and their densities.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/data/model.hpp"

namespace posevote {

namespace density {
class PoseIndex;
}

/// Poses in SE(3), structure of arrays. Vote v belongs to correspondence v /
/// votes_per_correspondence.
struct VoteSet {
  std::shared_ptr<const Model> model;
  std::uint32_t votes_per_correspondence = 0;  ///< N_r
  std::vector<std::uint32_t> scene_feature;  ///< per correspondence: row of the scene's FeatureSet
  std::vector<float> tx, ty, tz;      ///< where the model's centre lands in the scene [m] (not the
                                      ///< translation of T_scene_model: that is t - R c)
  std::vector<float> qw, qx, qy, qz;  ///< rotation R_scene_model, unit quaternion (sign arbitrary)
};

/// The kernel density of every vote of one VoteSet (paper, eq. 10).
struct VoteDensity {
  std::vector<double> density;  ///< >= 1: a vote is its own neighbour; 0: not a finite pose
  std::shared_ptr<const density::PoseIndex>
      index;  ///< of the same votes: neighbourhoods and subtraction
};

}  // namespace posevote
