// SPDX-License-Identifier: BSD-3-Clause
// The votes of noise-free correspondences under random poses, and each trap of the method.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "nodes/density/find_modes.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/votes.hpp"

namespace posevote::cast_votes_test {
namespace {

using test::random_direction;
using test::run_node;

constexpr double kDegree = std::numbers::pi / 180;

/// A model of random oriented points, and a scene that holds it under a random pose.
struct Example {
  std::shared_ptr<Model> model = std::make_shared<Model>();
  FeatureSet scene;
  Correspondences matches;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
};

Eigen::Isometry3d pose_of(const VoteSet& votes, std::uint32_t vote) {
  return T_scene_model_of(density::vote_hypothesis(votes, vote), votes.model->center);
}

void place(Example& example, std::mt19937& random) {
  const FeatureSet& model = example.model->features;
  example.T_scene_model = Eigen::Translation3d(random_direction(random).cast<double>()) *
                          test::random_rotation(random).cast<double>().normalized();
  const Eigen::Isometry3f T = example.T_scene_model.cast<float>();
  example.scene.points = (T * model.points.transpose()).transpose();
  example.scene.normals = (T.linear() * model.normals.transpose()).transpose();
  example.matches.model = example.model;
  for (std::uint32_t i = 0; i < model.points.rows(); ++i) {
    example.matches.scene_feature.push_back(i);
    example.matches.model_feature.push_back(i);
  }
}

Example random_example(unsigned seed, Eigen::Index count = 20) {
  std::mt19937 random(seed);
  Example example;
  example.model->center = 0.3F * random_direction(random);
  FeatureSet& features = example.model->features;
  features.points.resize(count, 3);
  features.normals.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    features.points.row(i) = example.model->center + 0.1F * random_direction(random);
    features.normals.row(i) = random_direction(random);
  }
  place(example, random);
  return example;
}

/// Every normal passes through the centre: |r| is 0 up to rounding.
Example sphere_example() {
  std::mt19937 random(5);
  Example example = random_example(5);
  FeatureSet& features = example.model->features;
  for (Eigen::Index i = 0; i < features.points.rows(); ++i)
    features.points.row(i) = example.model->center.transpose() + 0.125F * features.normals.row(i);
  example.matches = {};
  place(example, random);
  return example;
}

VoteSet cast(const Example& example, const std::string& rotations = "60") {
  return run_node<VoteSet>("cast_votes", {{"rotations", rotations}}, example.matches,
                           example.scene);
}

double angle_to(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

/// The vote of correspondence i whose rotation is nearest to the truth.
std::uint32_t nearest_vote(const Example& example, const VoteSet& votes, std::uint32_t i) {
  const std::uint32_t count = votes.votes_per_correspondence;
  std::uint32_t best = i * count;
  for (std::uint32_t v = i * count; v < (i + 1) * count; ++v)
    if (angle_to(pose_of(votes, v), example.T_scene_model) <
        angle_to(pose_of(votes, best), example.T_scene_model))
      best = v;
  return best;
}

TEST_CASE("one vote of a true correspondence is the true pose", "[vote]") {
  const Example example = random_example(GENERATE(1, 2, 3, 4));
  const VoteSet votes = cast(example);
  REQUIRE(votes.tx.size() == 20 * 60);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const std::uint32_t v = nearest_vote(example, votes, i);
    const double angle = angle_to(pose_of(votes, v), example.T_scene_model);
    REQUIRE(angle <= 3.001 * kDegree);
    // The centre is off by the chord of that angle on a circle no wider than 0.1 m.
    const Eigen::Vector3d center(example.model->center.cast<double>());
    const double distance = (pose_of(votes, v) * center - example.T_scene_model * center).norm();
    REQUIRE(distance <= 2 * 0.1 * std::sin(angle / 2) + 1e-6);
  }
}

TEST_CASE("every vote carries the model's oriented point onto the scene's", "[vote]") {
  const Example example = GENERATE(random_example(6), sphere_example());
  const VoteSet votes = cast(example, GENERATE("1", "7", "60"));
  for (std::uint32_t v = 0; v < votes.tx.size(); ++v) {
    const Eigen::Index i = v / votes.votes_per_correspondence;
    const Eigen::Isometry3d T = pose_of(votes, v);
    const FeatureSet& model = example.model->features;
    const Eigen::Vector3d p = T * Eigen::Vector3d(model.points.row(i).cast<double>());
    const Eigen::Vector3d n = T.linear() * Eigen::Vector3d(model.normals.row(i).cast<double>());
    REQUIRE((p - example.scene.points.row(i).transpose().cast<double>()).norm() < 2e-6);
    REQUIRE((n - example.scene.normals.row(i).transpose().cast<double>()).norm() < 2e-6);
    const Eigen::Vector4d q(votes.qw[v], votes.qx[v], votes.qy[v], votes.qz[v]);
    REQUIRE(q.norm() == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("the votes of a correspondence are evenly turned", "[vote]") {
  const VoteSet votes = cast(random_example(7, 1), "12");
  for (std::uint32_t v = 1; v < 12; ++v)
    CHECK(angle_to(pose_of(votes, v - 1), pose_of(votes, v)) == Approx(30 * kDegree));
}

TEST_CASE("normals through the centre still give all turns, about one centre", "[vote]") {
  const Example example = sphere_example();
  const VoteSet votes = cast(example);
  const Eigen::Vector3d center = example.T_scene_model * example.model->center.cast<double>();
  for (std::uint32_t i = 0; i < 20; ++i) {
    const std::uint32_t v = nearest_vote(example, votes, i);
    CHECK(angle_to(pose_of(votes, v), example.T_scene_model) <= 3.001 * kDegree);
    for (std::uint32_t k = i * 60; k < (i + 1) * 60; ++k)
      REQUIRE(
          (Eigen::Vector3f(votes.tx[k], votes.ty[k], votes.tz[k]).cast<double>() - center).norm() <
          1e-6);
  }
}

TEST_CASE("a flipped scene normal leaves no correct vote", "[vote]") {
  Example example = random_example(8);
  example.scene.normals *= -1;
  const VoteSet votes = cast(example);
  for (std::uint32_t v = 0; v < votes.tx.size(); ++v)
    REQUIRE(angle_to(pose_of(votes, v), example.T_scene_model) > 179 * kDegree);
}

VoteSet cast_in(const Example& example, const graph::FrameContext& frame) {
  const graph::NodeSpec* spec = graph::find_node("cast_votes");
  const auto params = spec->make_params();
  const auto outputs = spec->call({std::make_shared<const Correspondences>(example.matches),
                                   std::make_shared<const FeatureSet>(example.scene)},
                                  frame, params.get());
  return graph::StreamTraits<VoteSet>::unwrap(outputs.at(0));
}

TEST_CASE("circles start by seed, object and correspondence, not by frame", "[vote]") {
  Example example = random_example(9, 3);
  const VoteSet votes = cast_in(example, {.number = 0, .name = "a", .out = {}, .seed = 1});
  CHECK(cast_in(example, {.number = 7, .name = "b", .out = {}, .seed = 1}).tx == votes.tx);
  CHECK(cast_in(example, {.number = 0, .name = "a", .out = {}, .seed = 2}).tx != votes.tx);
  // The same match twice: two numbers, two starts.
  example.matches.scene_feature = {0, 0};
  example.matches.model_feature = {0, 0};
  const VoteSet twice = cast_in(example, {.number = 0, .name = "a", .out = {}, .seed = 1});
  CHECK(twice.tx[0] == votes.tx[0]);
  CHECK(twice.tx[60] != votes.tx[0]);
  example.model->obj_id = 2;
  CHECK(cast_in(example, {.number = 0, .name = "a", .out = {}, .seed = 1}).tx != twice.tx);
}

TEST_CASE("no correspondences, no votes", "[vote]") {
  Example example = random_example(10);
  example.matches.scene_feature.clear();
  example.matches.model_feature.clear();
  const VoteSet votes = cast(example);
  CHECK(votes.tx.empty());
  CHECK(votes.model == example.model);
  CHECK(votes.votes_per_correspondence == 60);
}

TEST_CASE("correspondences of unusable points cast no votes", "[vote]") {
  Example example = random_example(11, 5);
  const VoteSet all = cast(example);
  example.scene.normals.row(1).setZero();
  example.scene.points(3, 2) = std::numeric_limits<float>::quiet_NaN();
  example.model->features.normals(4, 0) = std::numeric_limits<float>::infinity();
  const VoteSet votes = cast(example);
  CHECK(votes.scene_feature == std::vector<std::uint32_t>{0, 2});
  REQUIRE(votes.tx.size() == 2 * 60);
  CHECK(votes.qw[60] == all.qw[2 * 60]);  // the others vote as if nothing were missing
}

TEST_CASE("correspondences that do not fit their features are refused", "[vote]") {
  Example example = random_example(12);
  example.matches.scene_feature[3] = 20;
  CHECK_THROWS_WITH(cast(example), Catch::Contains("scene feature 20, there are 20"));
  example = random_example(12);
  example.matches.model_feature[3] = 99;
  CHECK_THROWS_WITH(cast(example), Catch::Contains("model feature 99, there are 20"));
  example.matches.model_feature.pop_back();
  CHECK_THROWS_WITH(cast(example), Catch::Contains("20 scene features but 19 model features"));
  CHECK_THROWS_AS(cast(random_example(12), "0"), std::invalid_argument);
}

}  // namespace
}  // namespace posevote::cast_votes_test
