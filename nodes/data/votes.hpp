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

/// Poses in SE(3), structure of arrays: the circles of all correspondences, vote v on that of
/// correspondence v / votes_per_correspondence, and behind them single votes, one for each pose.
struct VoteSet {
  std::shared_ptr<const Model> model;
  std::uint32_t votes_per_correspondence = 0;  ///< N_r
  std::vector<std::uint32_t> scene_feature;   ///< per correspondence: row of the scene's FeatureSet
  std::vector<std::uint32_t> single_feature;  ///< per single vote: row of the scene's FeatureSet
  std::vector<float> tx, ty, tz;      ///< where the model's centre lands in the scene [m] (not the
                                      ///< translation of T_scene_model: that is t - R c)
  std::vector<float> qw, qx, qy, qz;  ///< rotation R_scene_model, unit quaternion (sign arbitrary)

  std::size_t circle_votes() const { return scene_feature.size() * votes_per_correspondence; }
  std::size_t size() const { return circle_votes() + single_feature.size(); }

  void add_single(const Eigen::Vector3f& center, const Eigen::Quaternionf& rotation,
                  std::uint32_t feature) {
    single_feature.push_back(feature);
    tx.push_back(center.x());
    ty.push_back(center.y());
    tz.push_back(center.z());
    qw.push_back(rotation.w());
    qx.push_back(rotation.x());
    qy.push_back(rotation.y());
    qz.push_back(rotation.z());
  }
};

/// The kernel density of every vote of one VoteSet (paper, eq. 10).
struct VoteDensity {
  std::vector<double> density;  ///< >= 1: a vote is its own neighbour; 0: not a finite pose
  std::shared_ptr<const density::PoseIndex>
      index;  ///< of the same votes: neighbourhoods and subtraction
};

}  // namespace posevote
