// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "nodes/density/find_modes.hpp"
#include "nodes/density/pose_index.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/votes.hpp"

namespace posevote::fold_votes_test {

using namespace posevote::test;

namespace {

const Eigen::Vector3f kAxis = Eigen::Vector3f(1, 2, -2) / 3;

/// Round about an axis beside its centre.
std::shared_ptr<const Model> round_model(int axes = 1) {
  auto model = std::make_shared<Model>();
  model->center = {0.1F, 0.05F, 0};
  model->symmetries.fixed_point = {0.11F, 0.05F, 0.02F};
  if (axes > 0) model->symmetries.axes = {kAxis};
  if (axes > 1) model->symmetries.axes.push_back(kAxis.unitOrthogonal());
  return model;
}

/// Single votes for T with turns about the axis through the fixed point, `count` of them.
VoteSet turned(const std::shared_ptr<const Model>& model, const Eigen::Isometry3f& T, int count) {
  VoteSet votes;
  votes.model = model;
  for (int k = 0; k < count; ++k) {
    const Eigen::Isometry3f motion =
        T * Eigen::Translation3f(model->symmetries.fixed_point) *
        Eigen::AngleAxisf(static_cast<float>(2 * std::numbers::pi * k / count), kAxis) *
        Eigen::Translation3f(-model->symmetries.fixed_point);
    votes.add_single(motion * model->center, Eigen::Quaternionf(motion.linear()), 0);
  }
  return votes;
}

Eigen::Isometry3f pose_of(const VoteSet& votes, std::uint32_t vote) {
  return T_scene_model_of(density::vote_hypothesis(votes, vote), votes.model->center).cast<float>();
}

double highest_density(const VoteSet& votes) {
  const auto densities = density::PoseIndex(votes, density::Bandwidth{}).densities();
  return *std::max_element(densities.begin(), densities.end());
}

}  // namespace

TEST_CASE("all turns about an axis become one pose that looks alike", "[vote]") {
  std::mt19937 random(3);
  const auto model = round_model();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3f T = Eigen::Translation3f(random_direction(random)) *
                                Eigen::Quaternionf(random_rotation(random)).normalized();
    const VoteSet given = turned(model, T, 60);
    const VoteSet folded = run_node<VoteSet>("fold_votes", {}, given);
    REQUIRE(folded.size() == 60);
    const Eigen::Isometry3f first = pose_of(folded, 0);
    for (std::uint32_t v = 0; v < 60; ++v) {
      const Eigen::Isometry3f pose = pose_of(folded, v);
      CHECK((pose.matrix() - first.matrix()).norm() < 2e-3F);
      // The axis stays where it was.
      const Eigen::Vector3f on_axis = model->symmetries.fixed_point + 0.3F * kAxis;
      CHECK((pose * on_axis - T * on_axis).norm() < 1e-5F);
      CHECK((pose * model->symmetries.fixed_point - T * model->symmetries.fixed_point).norm() <
            1e-5F);
    }
    CHECK(highest_density(folded) > 5 * highest_density(given));
  }
}

TEST_CASE("a ball has one rotation", "[vote]") {
  std::mt19937 random(4);
  const auto model = round_model(2);
  VoteSet given = turned(model, Eigen::Isometry3f::Identity(), 1);
  for (int i = 0; i < 9; ++i) {
    const Eigen::Quaternionf q(random_rotation(random));
    given.add_single(
        model->symmetries.fixed_point + q * (model->center - model->symmetries.fixed_point), q, 0);
  }
  const VoteSet folded = run_node<VoteSet>("fold_votes", {}, given);
  for (std::uint32_t v = 1; v < 10; ++v) {
    CHECK(folded.qw[v] == folded.qw[0]);
    CHECK(folded.qx[v] == folded.qx[0]);
    CHECK(folded.tx[v] == Approx(folded.tx[0]));
    CHECK(folded.tz[v] == Approx(folded.tz[0]));
  }
}

TEST_CASE("votes without an axis, or that are not to be folded, stay", "[vote]") {
  const Eigen::Isometry3f T(Eigen::AngleAxisf(1, Eigen::Vector3f::UnitX()));
  const VoteSet plain = turned(round_model(0), T, 9);
  CHECK(run_node<VoteSet>("fold_votes", {}, plain).qx == plain.qx);
  const VoteSet round = turned(round_model(), T, 9);
  CHECK(run_node<VoteSet>("fold_votes", {{"enabled", "false"}}, round).qx == round.qx);
  CHECK(run_node<VoteSet>("fold_votes", {}, round).qx != round.qx);
  CHECK(run_node<VoteSet>("fold_votes", {}, VoteSet{}).size() == 0);
}

TEST_CASE("what is no number stays none", "[vote]") {
  const auto model = round_model();
  VoteSet votes = turned(model, Eigen::Isometry3f::Identity(), 1);
  votes.add_single({0, NAN, 0}, {NAN, 0, 0, 0}, 0);
  const VoteSet folded = run_node<VoteSet>("fold_votes", {}, votes);
  CHECK(std::isfinite(folded.tx[0] + folded.qw[0]));
  CHECK_FALSE(std::isfinite(folded.tx[1] + folded.qw[1]));
}

}  // namespace posevote::fold_votes_test
