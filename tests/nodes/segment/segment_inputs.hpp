// SPDX-License-Identifier: BSD-3-Clause
// Scans, votes and densities for the tests of segment_objects.
#pragma once

#include "nodes/data/detections.hpp"
#include "nodes/data/votes.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::test {

/// Everything segment_objects takes.
struct SegmentInputs {
  PerObject<VoteSet> votes;
  PerObject<VoteDensity> densities;
  FeatureSet features;
  Cloud scan;
};

inline void add_object(SegmentInputs& inputs, const Correspondences& matches) {
  const auto votes = std::make_shared<const VoteSet>(
      run_node<VoteSet>("cast_votes", {}, matches, inputs.features));
  inputs.votes.slots.push_back(votes);
  inputs.densities.slots.push_back(
      std::make_shared<const VoteDensity>(run_node<VoteDensity>("estimate_density", {}, *votes)));
}

inline SegmentInputs inputs_of(const std::vector<Placed>& bodies, const std::vector<int>& shapes,
                               double wrong = 0.5) {
  SegmentInputs inputs;
  inputs.scan = scan_of(bodies);
  inputs.features = features_of(inputs.scan);
  for (const int shape : shapes)
    add_object(inputs, match_truly(bumpy_model(shape), inputs.features, bodies, wrong));
  return inputs;
}

using Values = std::map<std::string, std::string>;

/// With what is rejected.
inline Detections segment_all(const SegmentInputs& in, const Values& values = {}) {
  return run_node<Detections>("segment_objects", values, in.votes, in.densities, in.features,
                              in.scan, Scale{kResolution});
}

inline std::vector<Detection> segment(const SegmentInputs& in, const Values& values = {}) {
  return segment_all(in, values).items;
}

inline double turn_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

inline double shift_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

inline const Placed kLeft{1, pose(-0.08, 0.01, 0.8, 0.7)};
inline const Placed kRight{2, pose(0.09, -0.02, 0.75, 2.5)};

}  // namespace posevote::test
