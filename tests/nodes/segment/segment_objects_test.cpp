// SPDX-License-Identifier: BSD-3-Clause
#include <oneapi/tbb/global_control.h>

#include <catch2/catch.hpp>
#include <set>

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
  inputs.densities.slots.push_back(
      std::make_shared<const VoteDensity>(run_node<VoteDensity>("estimate_density", {}, *votes)));
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

TEST_CASE("a pose that few features voted for scores lower", "[segment]") {
  const std::vector<Detection> all = segment(inputs_of({kLeft}, {1}, 0));
  const Inputs sparse = inputs_of({kLeft}, {1}, 0.97);
  const std::vector<Detection> few = segment(sparse);
  REQUIRE(all.size() == 1);
  REQUIRE(few.size() == 1);
  CHECK(shift_between(few[0].T_scene_model, all[0].T_scene_model) < 0.1 * kResolution);
  CHECK(few[0].density < 0.1 * all[0].density);
  CHECK(few[0].inlier_fraction == Approx(all[0].inlier_fraction).margin(0.01));
  CHECK(few[0].score < 0.8 * all[0].score);
  CHECK(segment(sparse, {{"min_score", std::to_string(1.01 * few[0].score)}}).empty());
}

TEST_CASE("two instances of one object are both found", "[segment]") {
  const Placed left{1, pose(-0.09, 0.01, 0.8, 0.7)}, right{1, pose(0.09, -0.02, 0.75, 2.5)};
  const Inputs inputs = inputs_of({left, right}, {1});
  CHECK(segment(inputs).size() == 1);
  const std::vector<Detection> found = segment(inputs, {{"max_instances", "5"}});
  REQUIRE(found.size() == 2);
  for (const Placed& truth : {left, right}) {
    const auto error = [&truth](const Detection& d) {
      return shift_between(d.T_scene_model, truth.T_scene_model);
    };
    CHECK(std::min(error(found[0]), error(found[1])) < 0.1 * kResolution);
  }
  CHECK(found[0].runner_up_density > 0.5 * found[0].density);  // the other instance
}

TEST_CASE("an object that is not there is not found", "[segment]") {
  const std::vector<Detection> found =
      segment(inputs_of({kLeft}, {1, 3}), {{"max_instances", "3"}});
  REQUIRE(found.size() == 1);
  CHECK(found.front().obj_id == 1);
}

TEST_CASE("a scan fully explained leaves nothing for later objects", "[segment]") {
  Inputs inputs;
  inputs.scan = scan_of({kLeft}, false);
  inputs.features = features_of(inputs.scan);
  const Correspondences matches = match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.3);
  add_object(inputs, matches);
  add_object(inputs, matches);
  CHECK(segment(inputs, {{"max_instances", "3"}, {"min_score", "0"}}).size() == 1);
}

TEST_CASE("without votes there are no detections", "[segment]") {
  Inputs inputs;
  inputs.scan = scan_of({kLeft});
  inputs.features = features_of(inputs.scan);
  CHECK(segment(inputs).empty());
  Correspondences none;
  none.model = bumpy_model(2);
  add_object(inputs, none);
  CHECK(segment(inputs).empty());
  add_object(inputs, match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.5));
  CHECK(segment(inputs).size() == 1);
}

TEST_CASE("votes on an empty or unoriented scan find nothing", "[segment]") {
  Inputs inputs = inputs_of({kLeft}, {1});
  inputs.scan.normals.setZero();
  CHECK(segment(inputs).empty());
  inputs.scan = Cloud{};
  CHECK(segment(inputs).empty());
}

TEST_CASE("the order of the objects does not matter", "[segment]") {
  Inputs inputs = inputs_of({kLeft, kRight}, {1, 2, 3});
  const std::vector<Detection> found = segment(inputs);
  std::reverse(inputs.votes.slots.begin(), inputs.votes.slots.end());
  std::reverse(inputs.densities.slots.begin(), inputs.densities.slots.end());
  const std::vector<Detection> again = segment(inputs);
  REQUIRE(found.size() == again.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].obj_id == again[i].obj_id);
    CHECK(found[i].T_scene_model.matrix() == again[i].T_scene_model.matrix());
  }
}

TEST_CASE("the object that fits best comes first, whatever votes for another", "[segment]") {
  Inputs inputs = inputs_of({kLeft}, {});
  auto decoy = std::make_shared<Model>(*bumpy_model(1));  // alike on one half
  decoy->obj_id = 0;
  for (Eigen::Index i = 0; i < decoy->cloud.points.rows(); ++i)
    if (decoy->cloud.points(i, 0) > decoy->center.x())
      decoy->cloud.points.row(i) += 0.02F * decoy->cloud.normals.row(i);
  Correspondences for_decoy = match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.1);
  for_decoy.model = decoy;
  add_object(inputs, for_decoy);
  CHECK(segment(inputs).size() == 1);  // it would be found
  add_object(inputs, match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.8));
  const std::vector<Detection> found = segment(inputs);
  REQUIRE(found.size() == 1);
  CHECK(found.front().obj_id == 1);
  CHECK(shift_between(found.front().T_scene_model, kLeft.T_scene_model) < 0.1 * kResolution);
}

TEST_CASE("what the first object explains is gone for the second as if never matched",
          "[segment]") {
  const Inputs inputs = inputs_of({kLeft, kRight}, {1, 2});
  const std::vector<Detection> both = segment(inputs);
  REQUIRE(both.size() == 2);
  const std::size_t second = both[1].obj_id == 1 ? 0 : 1;
  const Placed& first_truth = second == 0 ? kRight : kLeft;
  // Vote for the second object alone, without the features on the first body.
  Inputs rest;
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
  const std::vector<Detection> alone = segment(rest);
  REQUIRE(alone.size() == 1);
  CHECK(shift_between(alone[0].T_scene_model, both[1].T_scene_model) < 1e-6);
  CHECK(turn_between(alone[0].T_scene_model, both[1].T_scene_model) < 1e-5);
  CHECK(alone[0].inlier_fraction == both[1].inlier_fraction);
}

TEST_CASE("a turned scan gives turned poses", "[segment]") {
  const std::vector<Placed> bodies{kLeft, kRight};
  Inputs inputs = inputs_of(bodies, {});
  const std::vector<Correspondences> matches{
      match_truly(bumpy_model(1), inputs.features, bodies, 0.5),
      match_truly(bumpy_model(2), inputs.features, bodies, 0.5)};
  for (const Correspondences& m : matches) add_object(inputs, m);
  const Eigen::Isometry3d T = pose(0.4, -1.0, 0.3, 1.9, {1, 0.2, -0.7});
  Inputs turned;
  turned.scan.points.resize(0, 3);
  turned.scan.normals.resize(0, 3);
  test::detail::append(turned.scan, inputs.scan, T);
  turned.scan.view.origin = T.translation().cast<float>();
  turned.features = features_of(turned.scan);
  for (const Correspondences& m : matches) add_object(turned, m);
  const std::vector<Detection> found = segment(inputs), again = segment(turned);
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
  const Inputs inputs = inputs_of({kLeft, kRight}, {1, 2, 3}, 0.8);
  const Values values{{"max_instances", "2"}, {"min_score", "0"}, {"candidates", "8"}};
  std::vector<std::vector<Detection>> runs;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    runs.push_back(segment(inputs, values));
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

TEST_CASE("numbers are finite and in range even where all matches are wrong", "[segment]") {
  const Inputs inputs = inputs_of({kLeft, kRight}, {1, 2, 4}, 1.0);
  const Values values{{"max_instances", "2"}, {"candidates", "10"}, {"min_score", "0"}};
  for (const Detection& d : segment(inputs, values)) {
    CHECK(d.T_scene_model.matrix().allFinite());
    CHECK(d.T_scene_model.linear().determinant() == Approx(1));
    CHECK((d.score >= 0 && d.score <= 1));
    CHECK((d.inlier_fraction >= 0 && d.inlier_fraction <= 1));
    CHECK(std::isfinite(d.rmse));
    CHECK(std::isfinite(d.density));
  }
}

TEST_CASE("ICP can be switched off, and then the mode itself is the pose", "[segment]") {
  const Inputs inputs = inputs_of({kLeft}, {1}, 0.2);
  const std::vector<Detection> rough = segment(inputs, {{"refine", "false"}});
  const std::vector<Detection> fine = segment(inputs);
  REQUIRE(rough.size() == 1);
  REQUIRE(fine.size() == 1);
  CHECK(shift_between(rough[0].T_scene_model, kLeft.T_scene_model) < 2 * kResolution);
  CHECK(turn_between(rough[0].T_scene_model, kLeft.T_scene_model) < 0.06);
  CHECK(rough[0].rmse > fine[0].rmse);
  CHECK(rough[0].density == fine[0].density);
}

TEST_CASE("thresholds on density and score reject", "[segment]") {
  const Inputs inputs = inputs_of({kLeft}, {1});
  REQUIRE(segment(inputs).size() == 1);
  CHECK(segment(inputs, {{"min_density", "100000"}}).empty());
  CHECK(segment(inputs, {{"min_score", "1"}}).empty());
}

TEST_CASE("lengths and normals that cannot be are refused", "[segment]") {
  Inputs inputs;
  inputs.scan = scan_of({kLeft});
  inputs.features = features_of(inputs.scan);
  for (const float resolution : {0.0F, -1.0F, std::nanf(""), HUGE_VALF})
    CHECK_THROWS_WITH(run_node<Detections>("segment_objects", {}, inputs.votes, inputs.densities,
                                           inputs.features, inputs.scan, Scale{resolution}),
                      Catch::Contains("resolution"));
  inputs.scan.normals.resize(0, 3);
  CHECK_THROWS_WITH(segment(inputs), Catch::Contains("the scan has"));
  inputs.scan = scan_of({kLeft});
  inputs.features.normals.resize(1, 3);
  CHECK_THROWS_WITH(segment(inputs), Catch::Contains("the feature set has"));
}
