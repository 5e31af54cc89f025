// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "nodes/data/votes.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/votes.hpp"

namespace posevote::textbook_density_test {

using namespace posevote::test;

namespace {

/// Votes in a cube of 10 cm, of which each has some dozens near in translation.
VoteSet random_votes(std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-0.05F, 0.05F);
  std::normal_distribution<float> normal;
  VoteSet votes;
  votes.votes_per_correspondence = 1;
  for (std::size_t i = 0; i < count; ++i) {
    votes.scene_feature.push_back(0);
    votes.tx.push_back(place(random)), votes.ty.push_back(place(random));
    votes.tz.push_back(place(random));
    const Eigen::Quaternionf q =
        Eigen::Quaternionf(3 + normal(random), normal(random), normal(random), normal(random))
            .normalized();
    votes.qw.push_back(q.w()), votes.qx.push_back(q.x()), votes.qy.push_back(q.y());
    votes.qz.push_back(q.z());
  }
  return votes;
}

}  // namespace

TEST_CASE("the textbook's densities are ours to the last bit", "[baseline]") {
  VoteSet votes = random_votes(20000);
  votes.tx[7] = std::numeric_limits<float>::quiet_NaN();
  votes.qw[9] = 3;
  const auto ours = run_node<VoteDensity>("estimate_density", kTenMillimetres, votes).density;
  CHECK(run_node<VoteDensity>("textbook_density", kTenMillimetres, votes).density == ours);
  CHECK(ours[7] == 0);
  CHECK(*std::max_element(ours.begin(), ours.end()) > 3);
}

TEST_CASE("the textbook has no densities of no votes", "[baseline]") {
  CHECK(run_node<VoteDensity>("textbook_density", kTenMillimetres, VoteSet{}).density.empty());
}

}  // namespace posevote::textbook_density_test
