// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the density, as wide as the processor allows: a few votes against blocks of
// others, and which votes are near a box.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/density/kernel.hpp"

namespace posevote::density {

/// Votes as seven arrays one behind the other, in the order of VotePoint. Up to kScanPadding floats
/// behind the last of each are read.
struct VoteColumns {
  const float* first;
  std::size_t stride;  ///< from one array to the next

  const float* operator[](std::size_t column) const { return first + column * stride; }
};

constexpr std::size_t kVoteColumns = 7;
constexpr std::size_t kScanPadding = 64;

/// Votes begin to end - 1 of the columns.
struct IndexRange {
  std::uint32_t begin = 0, end = 0;
};

/// Votes are looked at in blocks: vote i lies in block i / kBlock. All of a block count, so
/// that what is behind the last vote must be far away (VoteTable::close).
constexpr std::uint32_t kBlock = 16;

/// Queries that look at votes together.
constexpr std::uint32_t kGroup = 4;

/// The blocks that a group looks at, each once.
struct Blocks {
  const IndexRange* ranges;  ///< of blocks
  std::size_t count;         ///< of ranges
};

/// Numbers that `found` of scan_votes holds for each block: where vectors have one lane, all votes.
constexpr std::size_t kFoundPerBlock = std::size_t{kGroup} * kBlock;

/// Whose sum 32 bits hold: so many queries may add to `back` before it is emptied.
constexpr std::uint32_t kMostWeights = 1023;

/// Scans for one set among itself: what a vote weighs at a query the query weighs at the vote.
struct Mutual {
  float* leaving;  ///< of the queries, which lie one behind the other in the table: the first's
                   ///< place in the first column. Each leaves the table before it is weighed.
  std::uint32_t* back;  ///< beside the table: each vote's weight at the queries is added to it
};

/// The sums over all votes of the blocks of their weights at each query, in units, `count` <=
/// kGroup of them. Each equals kernel_units bit for bit on every processor. `mutual` may be null.
/// `found`: room for kFoundPerBlock numbers a block, and kGroup.
void scan_votes(const Kernel& kernel, const VoteColumns& votes, const VotePoint* queries,
                std::size_t count, const Blocks& blocks, const Mutual* mutual, std::uint32_t* found,
                std::uint64_t* sums);

/// Writes the places of the range's votes that are neighbours of the query, ascending, and their
/// weights in units; returns how many. Both have room for all and kScanPadding more.
std::size_t collect_near(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         IndexRange range, std::uint32_t* places, std::uint32_t* weights);

}  // namespace posevote::density
