// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/refine_mode.hpp"

#include <Eigen/Eigenvalues>

#include "nodes/density/pose_index.hpp"

namespace posevote::density {
namespace {

std::vector<WeightedVote> living_neighbours(const VoteDensity& density,
                                            const std::vector<char>& alive,
                                            const Hypothesis& pose) {
  std::vector<WeightedVote> neighbours = density.index->neighbours(pose.center, pose.rotation);
  std::erase_if(neighbours, [&alive](const WeightedVote& n) { return !alive[n.vote]; });
  return neighbours;
}

double total_weight(const std::vector<WeightedVote>& neighbours) {
  double sum = 0;
  for (const WeightedVote& neighbour : neighbours) sum += static_cast<double>(neighbour.weight);
  return sum;
}

Hypothesis weighted_mean(const VoteSet& votes, const std::vector<WeightedVote>& neighbours) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix4d moment = Eigen::Matrix4d::Zero();
  double sum = 0;
  for (const auto& [vote, weight] : neighbours) {
    const Eigen::Vector4d q(votes.qx[vote], votes.qy[vote], votes.qz[vote], votes.qw[vote]);
    const auto w = static_cast<double>(weight);
    center += w * vote_center(votes, vote).cast<double>();
    moment += w * q * q.transpose();
    sum += w;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(moment);
  const Eigen::Vector4f mean = solver.eigenvectors().col(3).cast<float>();
  return {(center / sum).cast<float>(), Eigen::Quaternionf(mean).normalized(), 0};
}

}  // namespace

Hypothesis refine_mode(const VoteSet& votes, const VoteDensity& density,
                       const std::vector<char>& alive, const Hypothesis& start,
                       const ShiftTerms& terms) {
  Hypothesis pose = start;
  std::vector<WeightedVote> neighbours = living_neighbours(density, alive, pose);
  for (int shift = 0; shift < terms.most_shifts && !neighbours.empty(); ++shift) {
    const Hypothesis mean = weighted_mean(votes, neighbours);
    std::vector<WeightedVote> around_mean = living_neighbours(density, alive, mean);
    if (total_weight(around_mean) < total_weight(neighbours)) break;
    pose = mean;
    neighbours = std::move(around_mean);
  }
  pose.support = start.support;
  return pose;
}

double raw_density(const VoteDensity& density, const Hypothesis& pose) {
  return total_weight(density.index->neighbours(pose.center, pose.rotation));
}

}  // namespace posevote::density
