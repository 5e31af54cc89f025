// SPDX-License-Identifier: BSD-3-Clause
// The votes of one object in one scan, and how densely they lie: the first figure of Buch,
// Kiforenko, Kraft (ICCV 2017).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/data/votes.hpp"

namespace posevote::pictures {

struct DenseVotes {
  std::size_t count = 0;  ///< of all
  double largest = 0;     ///< density
  /// Where votes put the model's centre [m]: of all votes, by density, every n-th, the densest too;
  /// in ascending order of density.
  PointMatrix centers;
  std::vector<std::uint8_t> heat;  ///< 255 log(density) / log(largest)
};

/// At most `most` votes are kept. `density`: one a vote.
DenseVotes dense_votes(const VoteSet& votes, const std::vector<double>& density, std::size_t most);

}  // namespace posevote::pictures
