// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/find_modes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace posevote;

namespace {

/// Votes along the x axis, two per correspondence.
VoteSet votes_at(const std::vector<float>& x) {
  VoteSet votes;
  votes.votes_per_correspondence = 2;
  votes.tx = x;
  votes.ty.assign(x.size(), 0.0F);
  votes.tz.assign(x.size(), 0.0F);
  votes.qw.assign(x.size(), 1.0F);
  votes.qx = votes.qy = votes.qz = votes.tz;
  return votes;
}

std::vector<segment::PoseMode> modes_of(const VoteSet& votes) {
  std::vector<segment::PoseMode> modes;
  for (std::uint32_t v = 0; v < votes.tx.size(); ++v) modes.push_back(segment::vote_pose(votes, v));
  return modes;
}

const Eigen::Vector3f kOrigin = Eigen::Vector3f::Zero();

}  // namespace

TEST_CASE("each correspondence gives its best vote, the densest first", "[segment]") {
  const VoteSet votes = votes_at({0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(segment::best_votes(votes, {1, 4, 9, 2, 0, 0, 4, 3}, 0) ==
        std::vector<std::uint32_t>{2, 1, 6});
}

TEST_CASE("of equal votes the first is the best", "[segment]") {
  CHECK(segment::best_votes(votes_at({0, 1, 2, 3}), {3, 3, 5, 5}, 0) ==
        std::vector<std::uint32_t>{2, 0});
}

TEST_CASE("no votes have no modes", "[segment]") {
  CHECK(segment::best_votes(VoteSet{}, {}, 0).empty());
  CHECK(segment::best_votes(votes_at({}), {}, 0).empty());
  CHECK(segment::separate_modes({}, {1, 1, 3}, 9).empty());
  CHECK(segment::runner_up_density(votes_at({}), {}, kOrigin, 1.0F) == 0);
}

TEST_CASE("votes below the threshold are no modes", "[segment]") {
  const VoteSet votes = votes_at({0, 1, 2, 3});
  CHECK(segment::best_votes(votes, {1, 2, 3, 4}, 3) == std::vector<std::uint32_t>{3});
  CHECK(segment::best_votes(votes, {1, 2, 3, 4}, 2) == std::vector<std::uint32_t>{3, 1});
}

TEST_CASE("non-maximum suppression leaves out what lies within the distance", "[segment]") {
  const std::vector<segment::PoseMode> modes = modes_of(votes_at({0, 0.5F, 1.5F, 3}));
  using Numbers = std::vector<std::size_t>;
  CHECK(segment::separate_modes(modes, {1.0F, 1, 3}, 9) == Numbers{0, 2, 3});
  CHECK(segment::separate_modes(modes, {1.5F, 1, 3}, 9) == Numbers{0, 3});
  CHECK(segment::separate_modes(modes, {0.1F, 1, 3}, 9) == Numbers{0, 1, 2, 3});
  CHECK(segment::separate_modes(modes, {0.1F, 1, 3}, 2) == Numbers{0, 1});
}

TEST_CASE("a place may be judged in some quite different rotations", "[segment]") {
  VoteSet votes = votes_at({0, 0, 0, 0, 0, 0});
  const std::vector<float> degrees{0, 50, 90, 140, 180, 270};
  for (std::size_t v = 0; v < 6; ++v) {
    const float half = degrees[v] / 114.59156F;
    const float sign = v % 2 == 0 ? 1.0F : -1.0F;  // both name the same rotation
    votes.qw[v] = sign * std::cos(half);
    votes.qz[v] = sign * std::sin(half);
  }
  using Numbers = std::vector<std::size_t>;
  const float sixty = 1.0471976F;
  CHECK(segment::separate_modes(modes_of(votes), {1.0F, sixty, 3}, 9) == Numbers{0, 2, 4});
  CHECK(segment::separate_modes(modes_of(votes), {1.0F, sixty, 9}, 9) == Numbers{0, 2, 4, 5});
  CHECK(segment::separate_modes(modes_of(votes), {1.0F, sixty / 2, 9}, 9) ==
        Numbers{0, 1, 2, 3, 4, 5});
}

TEST_CASE("the runner-up is the densest vote elsewhere", "[segment]") {
  const VoteSet votes = votes_at({0, 0.5F, 2, 3});
  const std::vector<double> density{9, 8, 4, 5};
  CHECK(segment::runner_up_density(votes, density, kOrigin, 1.0F) == 5);
  CHECK(segment::runner_up_density(votes, density, kOrigin, 0.4F) == 8);
  CHECK(segment::runner_up_density(votes, density, kOrigin, 4.0F) == 0);
}
