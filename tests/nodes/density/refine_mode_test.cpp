// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/refine_mode.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nodes/density/pose_index.hpp"

namespace posevote::refine_mode_test {

using namespace posevote::density;

namespace {

const Eigen::Vector3f kCenter(0.1F, -0.2F, 0.7F);
const Eigen::Quaternionf kRotation(Eigen::AngleAxisf(2.0F,
                                                     Eigen::Vector3f(1, -2, 0.5F).normalized()));

void add_vote(VoteSet& votes, const Eigen::Vector3f& t, const Eigen::Quaternionf& q, float sign) {
  votes.tx.push_back(t.x());
  votes.ty.push_back(t.y());
  votes.tz.push_back(t.z());
  votes.qw.push_back(sign * q.w());
  votes.qx.push_back(sign * q.x());
  votes.qy.push_back(sign * q.y());
  votes.qz.push_back(sign * q.z());
}

/// Votes strewn about one pose, with quaternions of either sign.
VoteSet cluster(int count) {
  std::mt19937 random(5);
  const auto uniform = [&random] { return static_cast<float>(random()) / 2147483648.0F - 1.0F; };
  VoteSet votes;
  votes.votes_per_correspondence = 1;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f offset(uniform(), uniform(), uniform());
    const Eigen::Vector3f axis(uniform(), uniform(), uniform());
    const Eigen::Quaternionf turn(Eigen::AngleAxisf(0.15F * uniform(), axis.normalized()));
    add_vote(votes, kCenter + 0.004F * offset, turn * kRotation, i % 2 == 0 ? 1.0F : -1.0F);
  }
  return votes;
}

VoteDensity density_of(const VoteSet& votes) {
  const auto index = std::make_shared<density::PoseIndex>(votes, density::Bandwidth{});
  return {index->densities(), index};
}

}  // namespace

TEST_CASE("mean shift finds the middle of a cluster from its edge", "[density]") {
  const VoteSet votes = cluster(400);
  const VoteDensity density = density_of(votes);
  const std::vector<char> alive(400, 1);
  const Hypothesis start{
      kCenter + Eigen::Vector3f(0.003F, 0.003F, -0.003F),
      Eigen::Quaternionf(Eigen::AngleAxisf(0.12F, Eigen::Vector3f::UnitX())) * kRotation};
  const Hypothesis mode = density::refine_mode(votes, density, alive, start);
  CHECK((mode.center - kCenter).norm() < 0.0005F);
  CHECK(mode.rotation.angularDistance(kRotation) < 0.02F);
  CHECK(density::raw_density(density, mode) > density::raw_density(density, start));
}

TEST_CASE("a shift never lowers the density", "[density]") {
  const VoteSet votes = cluster(40);
  const VoteDensity density = density_of(votes);
  const std::vector<char> alive(40, 1);
  for (std::uint32_t vote = 0; vote < 40; ++vote) {
    const Hypothesis start = density::vote_hypothesis(votes, vote);
    const Hypothesis mode = density::refine_mode(votes, density, alive, start);
    CHECK(density::raw_density(density, mode) >= density::raw_density(density, start));
  }
}

TEST_CASE("a mean that loses one side's votes is not taken", "[density]") {
  VoteSet votes;
  votes.votes_per_correspondence = 1;
  const auto add = [&votes](int count, float x) {
    for (int i = 0; i < count; ++i)
      add_vote(votes, kCenter + Eigen::Vector3f(x, 0, 0), kRotation, 1.0F);
  };
  add(10, 0.0095F);
  add(6, -0.0095F);
  const VoteDensity density = density_of(votes);
  const Hypothesis start{kCenter, kRotation};
  const Hypothesis mode = density::refine_mode(votes, density, std::vector<char>(16, 1), start);
  CHECK(mode.center == start.center);
}

TEST_CASE("dead votes pull no mode", "[density]") {
  VoteSet votes = cluster(100);
  for (int i = 0; i < 200; ++i)
    add_vote(votes, kCenter + Eigen::Vector3f(0.006F, 0, 0), kRotation, 1.0F);
  const VoteDensity density = density_of(votes);
  std::vector<char> alive(300, 1);
  std::fill(alive.begin() + 100, alive.end(), 0);
  const Hypothesis mode = density::refine_mode(votes, density, alive, {kCenter, kRotation});
  CHECK((mode.center - kCenter).norm() < 0.001F);
}

TEST_CASE("a pose without neighbours stays", "[density]") {
  const VoteSet votes = cluster(10);
  const Hypothesis far{kCenter + Eigen::Vector3f(1, 0, 0), kRotation};
  const Hypothesis mode =
      density::refine_mode(votes, density_of(votes), std::vector<char>(10, 1), far);
  CHECK(mode.center == far.center);
}

TEST_CASE("mean shift goes no farther than it may", "[density]") {
  const VoteSet votes = cluster(400);
  const VoteDensity density = density_of(votes);
  const std::vector<char> alive(400, 1);
  const Hypothesis start{kCenter + Eigen::Vector3f(0.006F, 0, 0), kRotation};
  const auto way = [&](const density::ShiftTerms& terms) {
    return (density::refine_mode(votes, density, alive, start, terms).center - start.center).norm();
  };
  CHECK(way({0}) == 0);
  CHECK(way({1}) > 0.001F);
  CHECK(way({10}) > way({1}));
}

}  // namespace posevote::refine_mode_test
