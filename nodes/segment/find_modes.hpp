// SPDX-License-Identifier: BSD-3-Clause
// Modes of the vote density: one instance is the argmax (paper, eq. 12); many instances are the best
// vote of each correspondence, thinned by non-maximum suppression on where the model's centre lands
// (paper, section 4, "Multi-object and multi-instance recognition"). Linear in the number of votes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/data/votes.hpp"

namespace posevote {

/// Where vote `vote` puts the model's centre.
Eigen::Vector3f vote_center(const VoteSet& votes, std::uint32_t vote);

/// Per correspondence that still has votes (density > 0), its vote of highest density; the first of
/// equals. In descending order of density, equals in order of vote.
std::vector<std::uint32_t> best_votes(const VoteSet& votes, const std::vector<double>& density);

/// The first of `candidates` whose centre lies farther than `radius` from every centre in `taken`.
/// Taking modes one by one like this, candidates in descending order, is non-maximum suppression.
std::optional<std::uint32_t> next_mode(const VoteSet& votes,
                                       const std::vector<std::uint32_t>& candidates,
                                       const std::vector<Eigen::Vector3f>& taken, float radius);

/// The highest density among the votes whose centre lies farther than `radius` from `center`; 0 where
/// there are none.
double runner_up_density(const VoteSet& votes, const std::vector<double>& density,
                         const Eigen::Vector3f& center, float radius);

}  // namespace posevote
