// SPDX-License-Identifier: BSD-3-Clause
// What must not change what segment_objects finds: order, threads, where the sensor stood, and what
// another object has explained.
#include <oneapi/tbb/global_control.h>

#include <catch2/catch.hpp>

#include "tests/nodes/segment/segment_inputs.hpp"

namespace posevote::segment_invariance_test {

using namespace posevote::test;

TEST_CASE("the order of the objects does not matter", "[segment]") {
  SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2, 3});
  const std::vector<Detection> found = test::segment(inputs);
  std::reverse(inputs.votes.slots.begin(), inputs.votes.slots.end());
  std::reverse(inputs.densities.slots.begin(), inputs.densities.slots.end());
  const std::vector<Detection> again = test::segment(inputs);
  REQUIRE(found.size() == again.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].obj_id == again[i].obj_id);
    CHECK(found[i].T_scene_model.matrix() == again[i].T_scene_model.matrix());
  }
}

TEST_CASE("what the first object explains is gone for the second as if never matched",
          "[segment]") {
  const SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2});
  const std::vector<Detection> both = test::segment(inputs);
  REQUIRE(both.size() == 2);
  const std::size_t second = both[1].obj_id == 1 ? 0 : 1;
  const Placed& first_truth = second == 0 ? kRight : kLeft;
  // Vote for the second object alone, without the features on the first body.
  SegmentInputs rest;
  rest.scan = inputs.scan;
  rest.features = inputs.features;
  const VoteSet& all = inputs.votes[second];
  VoteSet left;
  left.model = all.model;
  left.votes_per_correspondence = all.votes_per_correspondence;
  for (std::size_t c = 0; c < all.scene_feature.size(); ++c) {
    const Eigen::RowVector3f p = inputs.features.points.row(all.scene_feature[c]);
    const Eigen::Vector3d center = first_truth.T_scene_model.translation();
    if ((p.transpose().cast<double>() - center).norm() < 0.1) continue;
    left.scene_feature.push_back(all.scene_feature[c]);
    for (std::size_t v = c * 60; v < (c + 1) * 60; ++v) {
      left.tx.push_back(all.tx[v]), left.ty.push_back(all.ty[v]), left.tz.push_back(all.tz[v]);
      left.qw.push_back(all.qw[v]), left.qx.push_back(all.qx[v]), left.qy.push_back(all.qy[v]);
      left.qz.push_back(all.qz[v]);
    }
  }
  CHECK(left.scene_feature.size() < all.scene_feature.size());
  rest.votes.slots = {std::make_shared<const VoteSet>(left)};
  rest.densities.slots = {
      std::make_shared<const VoteDensity>(run_node<VoteDensity>("estimate_density", {}, left))};
  const std::vector<Detection> alone = test::segment(rest);
  REQUIRE(alone.size() == 1);
  CHECK(shift_between(alone[0].T_scene_model, both[1].T_scene_model) < 1e-6);
  CHECK(turn_between(alone[0].T_scene_model, both[1].T_scene_model) < 1e-5);
  CHECK(alone[0].inlier_fraction == both[1].inlier_fraction);
}

TEST_CASE("a turned scan gives turned poses", "[segment]") {
  const std::vector<Placed> bodies{kLeft, kRight};
  SegmentInputs inputs = inputs_of(bodies, {});
  const std::vector<Correspondences> matches{
      match_truly(bumpy_model(1), inputs.features, bodies, 0.5),
      match_truly(bumpy_model(2), inputs.features, bodies, 0.5)};
  for (const Correspondences& m : matches) add_object(inputs, m);
  const Eigen::Isometry3d T = pose(0.4, -1.0, 0.3, 1.9, {1, 0.2, -0.7});
  SegmentInputs turned;
  turned.scan.points.resize(0, 3);
  turned.scan.normals.resize(0, 3);
  test::detail::append(turned.scan, inputs.scan, T);
  turned.scan.view.origin = T.translation().cast<float>();
  turned.features = features_of(turned.scan);
  for (const Correspondences& m : matches) add_object(turned, m);
  const std::vector<Detection> found = test::segment(inputs), again = test::segment(turned);
  REQUIRE(found.size() == 2);
  REQUIRE(again.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(found[i].obj_id == again[i].obj_id);
    CHECK(shift_between(T * found[i].T_scene_model, again[i].T_scene_model) < 0.05 * kResolution);
    CHECK(turn_between(T * found[i].T_scene_model, again[i].T_scene_model) < 0.003);
    CHECK(again[i].score == Approx(found[i].score).margin(0.02));
  }
}

TEST_CASE("one and two threads give the same bytes", "[segment]") {
  const SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2, 3}, 0.8);
  const Values values{{"max_instances", "2"}, {"min_score", "0"}, {"candidates", "8"}};
  std::vector<std::vector<Detection>> runs;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    runs.push_back(test::segment(inputs, values));
  }
  for (const std::vector<Detection>& run : runs) {
    REQUIRE(run.size() == runs[0].size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      CHECK(run[i].T_scene_model.matrix() == runs[0][i].T_scene_model.matrix());
      CHECK(run[i].score == runs[0][i].score);
      CHECK(run[i].density == runs[0][i].density);
      CHECK(run[i].rmse == runs[0][i].rmse);
    }
  }
}

}  // namespace posevote::segment_invariance_test
