// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/refine_mode.hpp"

#include <Eigen/Eigenvalues>

#include "nodes/density/pose_index.hpp"

namespace posevote::segment {
namespace {

constexpr int kMaxShifts = 10;
constexpr float kStill = 1e-3F;  // of the bandwidths: a shorter shift ends the search

std::vector<density::WeightedVote> living_neighbours(const VoteDensity& density,
                                                     const std::vector<char>& alive,
                                                     const PoseMode& pose) {
  std::vector<density::WeightedVote> neighbours =
      density.index->neighbours(pose.center, pose.rotation);
  std::erase_if(neighbours, [&alive](const density::WeightedVote& n) { return !alive[n.vote]; });
  return neighbours;
}

double total_weight(const std::vector<density::WeightedVote>& neighbours) {
  double sum = 0;
  for (const density::WeightedVote& neighbour : neighbours)
    sum += static_cast<double>(neighbour.weight);
  return sum;
}

PoseMode weighted_mean(const VoteSet& votes, const std::vector<density::WeightedVote>& neighbours) {
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

bool stands_still(const PoseMode& before, const PoseMode& after,
                  const density::Bandwidth& bandwidth) {
  return (after.center - before.center).norm() <= kStill * bandwidth.sigma_t &&
         before.rotation.angularDistance(after.rotation) <= kStill * bandwidth.sigma_r;
}

}  // namespace

PoseMode refine_mode(const VoteSet& votes, const VoteDensity& density,
                     const std::vector<char>& alive, const PoseMode& start) {
  PoseMode pose = start;
  std::vector<density::WeightedVote> neighbours = living_neighbours(density, alive, pose);
  for (int shift = 0; shift < kMaxShifts && !neighbours.empty(); ++shift) {
    const PoseMode mean = weighted_mean(votes, neighbours);
    std::vector<density::WeightedVote> around_mean = living_neighbours(density, alive, mean);
    if (total_weight(around_mean) < total_weight(neighbours)) break;
    const bool still = stands_still(pose, mean, density.index->bandwidth());
    pose = mean;
    neighbours = std::move(around_mean);
    if (still) break;
  }
  pose.support = start.support;
  return pose;
}

double raw_density(const VoteDensity& density, const PoseMode& pose) {
  return total_weight(density.index->neighbours(pose.center, pose.rotation));
}

Eigen::Isometry3d T_scene_model_of(const PoseMode& pose, const Eigen::Vector3f& model_center) {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  T_scene_model.linear() = pose.rotation.cast<double>().normalized().toRotationMatrix();
  T_scene_model.translation() =
      pose.center.cast<double>() - T_scene_model.linear() * model_center.cast<double>();
  return T_scene_model;
}

Eigen::Vector3d posed_center(const Eigen::Isometry3d& T_scene_model,
                             const Eigen::Vector3f& model_center) {
  return T_scene_model * model_center.cast<double>();
}

}  // namespace posevote::segment
