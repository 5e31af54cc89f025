// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/refine_mode.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nodes/density/pose_index.hpp"

using namespace posevote;

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

TEST_CASE("mean shift finds the middle of a cluster from its edge", "[segment]") {
  const VoteSet votes = cluster(400);
  const VoteDensity density = density_of(votes);
  const std::vector<char> alive(400, 1);
  const segment::PoseMode start{
      kCenter + Eigen::Vector3f(0.003F, 0.003F, -0.003F),
      Eigen::Quaternionf(Eigen::AngleAxisf(0.12F, Eigen::Vector3f::UnitX())) * kRotation};
  const segment::PoseMode mode = segment::refine_mode(votes, density, alive, start);
  CHECK((mode.center - kCenter).norm() < 0.0005F);
  CHECK(mode.rotation.angularDistance(kRotation) < 0.02F);
  CHECK(segment::raw_density(density, mode) > segment::raw_density(density, start));
}

TEST_CASE("a shift never lowers the density", "[segment]") {
  const VoteSet votes = cluster(40);
  const VoteDensity density = density_of(votes);
  const std::vector<char> alive(40, 1);
  for (std::uint32_t vote = 0; vote < 40; ++vote) {
    const segment::PoseMode start = segment::vote_pose(votes, vote);
    const segment::PoseMode mode = segment::refine_mode(votes, density, alive, start);
    CHECK(segment::raw_density(density, mode) >= segment::raw_density(density, start));
  }
}

TEST_CASE("a mean that loses one side's votes is not taken", "[segment]") {
  VoteSet votes;
  votes.votes_per_correspondence = 1;
  const auto add = [&votes](int count, float x) {
    for (int i = 0; i < count; ++i)
      add_vote(votes, kCenter + Eigen::Vector3f(x, 0, 0), kRotation, 1.0F);
  };
  add(10, 0.0095F);
  add(6, -0.0095F);
  const VoteDensity density = density_of(votes);
  const segment::PoseMode start{kCenter, kRotation};
  const segment::PoseMode mode =
      segment::refine_mode(votes, density, std::vector<char>(16, 1), start);
  CHECK(mode.center == start.center);
}

TEST_CASE("dead votes pull no mode", "[segment]") {
  VoteSet votes = cluster(100);
  for (int i = 0; i < 200; ++i)
    add_vote(votes, kCenter + Eigen::Vector3f(0.006F, 0, 0), kRotation, 1.0F);
  const VoteDensity density = density_of(votes);
  std::vector<char> alive(300, 1);
  std::fill(alive.begin() + 100, alive.end(), 0);
  const segment::PoseMode mode = segment::refine_mode(votes, density, alive, {kCenter, kRotation});
  CHECK((mode.center - kCenter).norm() < 0.001F);
}

TEST_CASE("a pose without neighbours stays", "[segment]") {
  const VoteSet votes = cluster(10);
  const segment::PoseMode far{kCenter + Eigen::Vector3f(1, 0, 0), kRotation};
  const segment::PoseMode mode =
      segment::refine_mode(votes, density_of(votes), std::vector<char>(10, 1), far);
  CHECK(mode.center == far.center);
}

TEST_CASE("votes say where the centre lands, poses where the origin does", "[segment]") {
  const Eigen::Vector3f model_center(0.05F, 0.02F, -0.3F);
  const Eigen::Isometry3d T_scene_model =
      segment::T_scene_model_of({kCenter, kRotation}, model_center);
  CHECK((T_scene_model * model_center.cast<double>() - kCenter.cast<double>()).norm() < 1e-7);
  const Eigen::Vector3d origin = T_scene_model * Eigen::Vector3d::Zero();
  CHECK((origin - (kCenter - kRotation * model_center).cast<double>()).norm() < 1e-6);
}
