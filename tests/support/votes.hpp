// SPDX-License-Identifier: BSD-3-Clause
// Synthetic votes for tests.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <random>
#include <string>

#include "nodes/data/votes.hpp"
#include "nodes/density/kernel.hpp"

namespace posevote::test {

/// The bandwidth of votes of no model, as a node's parameters: there is no size to derive it from.
inline const std::map<std::string, std::string> kTenMillimetres{{"sigma_t", "0.01"}};

inline void add_vote(VoteSet& votes, const Eigen::Vector3f& t, const Eigen::Quaternionf& q) {
  votes.votes_per_correspondence = 1;
  votes.scene_feature.push_back(static_cast<std::uint32_t>(votes.tx.size()));
  votes.tx.push_back(t.x());
  votes.ty.push_back(t.y());
  votes.tz.push_back(t.z());
  votes.qw.push_back(q.w());
  votes.qx.push_back(q.x());
  votes.qy.push_back(q.y());
  votes.qz.push_back(q.z());
}

inline Eigen::Vector3f random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
}

inline Eigen::Quaternionf random_rotation(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return Eigen::Quaternionf(normal(random), normal(random), normal(random), normal(random))
      .normalized();
}

/// Votes around `clusters` poses in a cube of edge `extent`, each within a few bandwidths of its
/// pose, some of them exact copies; signs of quaternions at random.
inline VoteSet clustered_votes(std::mt19937& random, std::size_t count, std::size_t clusters,
                               float extent, density::Bandwidth bandwidth) {
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<Eigen::Vector3f> t;
  std::vector<Eigen::Quaternionf> q;
  for (std::size_t c = 0; c < clusters; ++c) {
    t.push_back(extent / 2 * Eigen::Vector3f(uniform(random), uniform(random), uniform(random)));
    q.push_back(random_rotation(random));
  }
  VoteSet votes;
  while (votes.tx.size() < count) {
    const std::size_t c = random() % clusters;
    const float spread = random() % 8 == 0 ? 0.0F : 1.5F;
    const Eigen::Vector3f offset = spread * bandwidth.sigma_t * random_direction(random);
    const Eigen::AngleAxisf turn(spread * bandwidth.sigma_r * uniform(random),
                                 random_direction(random));
    Eigen::Quaternionf rotation = (turn * q[c]).normalized();
    if (random() % 2 == 0) rotation.coeffs() *= -1;
    add_vote(votes, t[c] + std::abs(uniform(random)) * offset, rotation);
  }
  return votes;
}

/// Votes all over a cube of edge `extent`, rotations uniform.
inline VoteSet spread_votes(std::mt19937& random, std::size_t count, float extent) {
  std::uniform_real_distribution<float> uniform(-extent / 2, extent / 2);
  VoteSet votes;
  for (std::size_t i = 0; i < count; ++i)
    add_vote(votes, {uniform(random), uniform(random), uniform(random)}, random_rotation(random));
  return votes;
}

}  // namespace posevote::test
