// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/data/detections.hpp"
#include "nodes/data/votes.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

using namespace posevote;
using namespace posevote::test;

namespace {

/// Everything segment_objects takes.
struct Inputs {
  PerObject<VoteSet> votes;
  PerObject<VoteDensity> densities;
  FeatureSet features;
  Cloud scan;
};

void add_object(Inputs& inputs, const Correspondences& matches) {
  const auto votes = std::make_shared<const VoteSet>(
      run_node<VoteSet>("cast_votes", {}, matches, inputs.features));
  inputs.votes.slots.push_back(votes);
  inputs.densities.slots.push_back(std::make_shared<const VoteDensity>(
      run_node<VoteDensity>("estimate_density", {}, *votes)));
}

Inputs inputs_of(const std::vector<Placed>& bodies, const std::vector<int>& shapes,
                 double wrong = 0.5) {
  Inputs inputs;
  inputs.scan = scan_of(bodies);
  inputs.features = features_of(inputs.scan);
  for (const int shape : shapes)
    add_object(inputs, match_truly(bumpy_model(shape), inputs.features, bodies, wrong));
  return inputs;
}

using Values = std::map<std::string, std::string>;

std::vector<Detection> segment(const Inputs& in, const Values& values = {}) {
  return run_node<Detections>("segment_objects", values, in.votes, in.densities, in.features,
                              in.scan, Scale{kResolution})
      .items;
}

double turn_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

double shift_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

const Placed kLeft{1, pose(-0.08, 0.01, 0.8, 0.7)};
const Placed kRight{2, pose(0.09, -0.02, 0.75, 2.5)};

}  // namespace

TEST_CASE("two objects are found at their poses", "[segment]") {
  const std::vector<Detection> found = segment(inputs_of({kLeft, kRight}, {1, 2}));
  REQUIRE(found.size() == 2);
  for (const Detection& d : found) {
    const Placed& truth = d.obj_id == 1 ? kLeft : kRight;
    INFO(d.model << " score " << d.score << " density " << d.density << " runner-up "
                 << d.runner_up_density << " inliers " << d.inlier_fraction << " rmse " << d.rmse);
    CHECK(shift_between(d.T_scene_model, truth.T_scene_model) < 0.1 * kResolution);
    CHECK(turn_between(d.T_scene_model, truth.T_scene_model) < 0.005);
    CHECK(d.score > 0.8);
    CHECK(d.density > 3 * d.runner_up_density);
    CHECK(d.inlier_fraction > 0.85);
    CHECK(d.rmse < 0.1 * kResolution);
  }
}
