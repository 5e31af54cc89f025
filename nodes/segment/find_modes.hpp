// SPDX-License-Identifier: BSD-3-Clause
// Modes of the vote density: one instance is the argmax (paper, eq. 12); many instances are the
// best vote of each correspondence, thinned by non-maximum suppression on where the model's centre
// lands (paper, section 4, "Multi-object and multi-instance recognition"). Modes that are still to
// be judged may lie three times as close, and a place may stand in for up to six rotations: an
// upside-down cup is a mode where the upright one is, and can be the denser. Linear in the number
// of votes.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "nodes/data/votes.hpp"

namespace posevote {

/// Where vote `vote` puts the model's centre.
Eigen::Vector3f vote_center(const VoteSet& votes, std::uint32_t vote);

/// A pose as votes express it.
struct PoseMode {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< where the model's centre lands [m]
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  double support = 0;  ///< what speaks for it before anything is judged: density, or a rival's own
};

/// The pose of one vote.
PoseMode vote_pose(const VoteSet& votes, std::uint32_t vote);

/// Per correspondence its vote of highest density, the first of equals, where that is above 0 and
/// at least `min_density`. In descending order of density, equals in order of vote.
std::vector<std::uint32_t> best_votes(const VoteSet& votes, const std::vector<double>& density,
                                      double min_density);

/// Non-maximum suppression: the first `count` of `modes` whose centres lie farther than `radius`
/// from every centre in `taken`, and than a third of it from each other unless their rotations
/// differ by more than 30 deg; at most six near one place.
std::vector<PoseMode> separate_modes(const std::vector<PoseMode>& modes,
                                     const std::vector<Eigen::Vector3f>& taken, float radius,
                                     std::size_t count);

/// The highest density among the votes whose centre lies farther than `radius` from `center`; 0
/// where there are none.
double runner_up_density(const VoteSet& votes, const std::vector<double>& density,
                         const Eigen::Vector3f& center, float radius);

}  // namespace posevote
