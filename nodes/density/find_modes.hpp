// SPDX-License-Identifier: BSD-3-Clause
// Modes of the vote density: one instance is the argmax (paper, eq. 12); many instances are the
// best vote of each correspondence, which then are thinned (paper, section 4, "Multi-object and
// multi-instance recognition"). Linear in the number of votes.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "nodes/data/hypotheses.hpp"
#include "nodes/data/votes.hpp"

namespace posevote::density {

/// Where vote `vote` puts the model's centre.
Eigen::Vector3f vote_center(const VoteSet& votes, std::uint32_t vote);

/// The pose of one vote, without support.
Hypothesis vote_hypothesis(const VoteSet& votes, std::uint32_t vote);

/// Per correspondence its vote of highest density, the first of equals, where that is above 0. In
/// descending order of density, equals in order of vote.
std::vector<std::uint32_t> best_votes(const VoteSet& votes, const std::vector<double>& density);

/// The highest density among the votes whose centre lies farther than `radius` from `center`; 0
/// where there are none.
double runner_up_density(const VoteSet& votes, const std::vector<double>& density,
                         const Eigen::Vector3f& center, float radius);

}  // namespace posevote::density
