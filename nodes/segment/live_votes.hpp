// SPDX-License-Identifier: BSD-3-Clause
// The votes of one object that no detection has explained away yet, and their densities. What goes
// is subtracted from the densities of what stays (PoseIndex::subtract), which equals voting anew
// without it.
#pragma once

#include <vector>

#include "graph/value.hpp"
#include "nodes/data/votes.hpp"

namespace posevote::segment {

struct LiveVotes {
  const VoteSet* votes = nullptr;
  const VoteDensity* raw = nullptr;  ///< of all votes
  std::vector<char> alive;           ///< per vote
  std::vector<double> left;          ///< densities; empty while all are alive

  /// Per vote, over those alive; 0 where not alive.
  const std::vector<double>& density() const { return left.empty() ? raw->density : left; }
};

LiveVotes all_votes(const VoteSet& votes, const VoteDensity& density);

/// Takes out the correspondences that start at a scene feature with explained[feature].
void remove_explained(LiveVotes& object, const std::vector<char>& explained);

/// Throws std::runtime_error where votes, densities and features do not belong together.
void check_votes(const PerObject<VoteSet>& votes, const PerObject<VoteDensity>& densities,
                 std::size_t scene_features);

}  // namespace posevote::segment
