// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/find_modes.hpp"

#include <catch2/catch.hpp>

using namespace posevote;

namespace {

/// Votes along the x axis, two per correspondence.
VoteSet votes_at(const std::vector<float>& x) {
  VoteSet votes;
  votes.votes_per_correspondence = 2;
  votes.tx = x;
  votes.ty.assign(x.size(), 0.0F);
  votes.tz.assign(x.size(), 0.0F);
  return votes;
}

const Eigen::Vector3f kOrigin = Eigen::Vector3f::Zero();

}  // namespace

TEST_CASE("each correspondence gives its best vote, the densest first", "[segment]") {
  const VoteSet votes = votes_at({0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(best_votes(votes, {1, 4, 9, 2, 0, 0, 4, 3}) == std::vector<std::uint32_t>{2, 1, 6});
}

TEST_CASE("of equal votes the first is the best", "[segment]") {
  CHECK(best_votes(votes_at({0, 1, 2, 3}), {3, 3, 5, 5}) == std::vector<std::uint32_t>{2, 0});
}

TEST_CASE("no votes have no modes", "[segment]") {
  CHECK(best_votes(VoteSet{}, {}).empty());
  CHECK(best_votes(votes_at({}), {}).empty());
  CHECK_FALSE(next_mode(votes_at({}), {}, {}, 1.0F));
  CHECK(runner_up_density(votes_at({}), {}, kOrigin, 1.0F) == 0);
}

TEST_CASE("non-maximum suppression leaves out what lies within the radius", "[segment]") {
  const VoteSet votes = votes_at({0, 0.5F, 1.5F, 3});
  const std::vector<std::uint32_t> candidates{0, 1, 2, 3};
  CHECK(next_mode(votes, candidates, {}, 1.0F) == 0U);
  CHECK(next_mode(votes, candidates, {{0, 0, 0}}, 1.0F) == 2U);
  CHECK(next_mode(votes, candidates, {{0, 0, 0}}, 1.5F) == 3U);
  CHECK_FALSE(next_mode(votes, candidates, {{0, 0, 0}, {3, 0, 0}}, 1.5F));
}

TEST_CASE("the runner-up is the densest vote elsewhere", "[segment]") {
  const VoteSet votes = votes_at({0, 0.5F, 2, 3});
  const std::vector<double> density{9, 8, 4, 5};
  CHECK(runner_up_density(votes, density, kOrigin, 1.0F) == 5);
  CHECK(runner_up_density(votes, density, kOrigin, 0.4F) == 8);
  CHECK(runner_up_density(votes, density, kOrigin, 4.0F) == 0);
}
