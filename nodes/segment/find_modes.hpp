// SPDX-License-Identifier: BSD-3-Clause
// Modes of the vote density: one instance is the argmax (paper, eq. 12); many instances are the
// best vote of each correspondence, thinned by non-maximum suppression on where the model's centre
// lands (paper, section 4, "Multi-object and multi-instance recognition"). A place may stand in for
// several quite different rotations: an upside-down cup is a mode where the upright one is, and can
// be the denser. Linear in the number of votes.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "nodes/data/votes.hpp"

namespace posevote::segment {

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

/// How far poses lie apart.
struct Separation {
  float distance;  ///< of their centres, unless they are turned [m]
  float angle;     ///< by more than this [rad],
  int per_place;   ///< at most so many
};

/// Whether two poses are not apart.
bool is_like(const PoseMode& a, const PoseMode& b, const Separation& separation);

/// Non-maximum suppression: the numbers of the first `count` modes that are separate from all of
/// those before.
std::vector<std::size_t> separate_modes(const std::vector<PoseMode>& modes,
                                        const Separation& separation, std::size_t count);

/// The highest density among the votes whose centre lies farther than `radius` from `center`; 0
/// where there are none.
double runner_up_density(const VoteSet& votes, const std::vector<double>& density,
                         const Eigen::Vector3f& center, float radius);

}  // namespace posevote::segment
