// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/find_modes.hpp"

#include <catch2/catch.hpp>

namespace posevote::find_modes_test {

using namespace posevote::density;

namespace {

/// Votes along the x axis, two per correspondence.
VoteSet votes_at(const std::vector<float>& x) {
  VoteSet votes;
  votes.votes_per_correspondence = 2;
  votes.scene_feature.assign(x.size() / 2, 0);
  votes.tx = x;
  votes.ty.assign(x.size(), 0.0F);
  votes.tz.assign(x.size(), 0.0F);
  votes.qw.assign(x.size(), 1.0F);
  votes.qx = votes.qy = votes.qz = votes.tz;
  return votes;
}

const Eigen::Vector3f kOrigin = Eigen::Vector3f::Zero();

}  // namespace

TEST_CASE("each correspondence gives its best vote, the densest first", "[density]") {
  const VoteSet votes = votes_at({0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(density::best_votes(votes, {1, 4, 9, 2, 0, 0, 4, 3}) ==
        std::vector<std::uint32_t>{2, 1, 6});
}

TEST_CASE("single votes stand for themselves", "[density]") {
  VoteSet votes = votes_at({0, 1, 2, 3});
  votes.add_single({4, 0, 0}, Eigen::Quaternionf::Identity(), 7);
  votes.add_single({5, 0, 0}, Eigen::Quaternionf::Identity(), 7);
  votes.add_single({6, 0, 0}, Eigen::Quaternionf::Identity(), 8);
  CHECK(density::best_votes(votes, {1, 4, 9, 2, 5, 5, 0}) ==
        std::vector<std::uint32_t>{2, 4, 5, 1});
}

TEST_CASE("a vote is a hypothesis without support", "[density]") {
  VoteSet votes = votes_at({1, 2});
  votes.qw[1] = 0, votes.qy[1] = 1;
  const Hypothesis pose = density::vote_hypothesis(votes, 1);
  CHECK(pose.center == Eigen::Vector3f(2, 0, 0));
  CHECK(pose.rotation.coeffs() == Eigen::Vector4f(0, 1, 0, 0));
  CHECK(pose.support == 0);
}

TEST_CASE("of equal votes the first is the best", "[density]") {
  CHECK(density::best_votes(votes_at({0, 1, 2, 3}), {3, 3, 5, 5}) ==
        std::vector<std::uint32_t>{2, 0});
}

TEST_CASE("no votes have no modes", "[density]") {
  CHECK(density::best_votes(VoteSet{}, {}).empty());
  CHECK(density::best_votes(votes_at({}), {}).empty());
  CHECK(density::runner_up_density(votes_at({}), {}, kOrigin, 1.0F) == 0);
}

TEST_CASE("a correspondence proposes its densest vote, if it has any density", "[density]") {
  const VoteSet votes = votes_at({0, 1, 2, 3});
  CHECK(density::best_votes(votes, {0, 0, 3, 4}) == std::vector<std::uint32_t>{3});
}

TEST_CASE("the runner-up is the densest vote elsewhere", "[density]") {
  const VoteSet votes = votes_at({0, 0.5F, 2, 3});
  const std::vector<double> density{9, 8, 4, 5};
  CHECK(density::runner_up_density(votes, density, kOrigin, 1.0F) == 5);
  CHECK(density::runner_up_density(votes, density, kOrigin, 0.4F) == 8);
  CHECK(density::runner_up_density(votes, density, kOrigin, 4.0F) == 0);
}

}  // namespace posevote::find_modes_test
