// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the density, as wide as the processor allows: one vote against runs of others,
// and which votes are near a box.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/vote/kernel.hpp"

namespace posevote {

/// Votes as seven arrays one behind the other, in the order of VotePoint. Up to kScanPadding floats
/// behind the last of each are read, not used.
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

/// Whose sum 32 bits hold: so many scans may add to `back` before it is emptied.
constexpr std::uint32_t kMostWeights = 1023;

/// The sum over all votes of the ranges of their weights at the query, in units. Equals
/// kernel_units bit for bit on every processor. Where `back` is not null, each vote's weight is
/// added to its place there, too, padded as the columns are: the kernel is symmetric, and what a
/// vote weighs at the query the query weighs at the vote.
std::uint64_t scan_votes(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         const IndexRange* ranges, std::size_t range_count, std::uint32_t* back);

/// Writes the places of the range's votes that are neighbours of the query, ascending, and their
/// weights in units; returns how many. Both have room for all and kScanPadding more.
std::size_t collect_near(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         IndexRange range, std::uint32_t* places, std::uint32_t* weights);

/// Bounding box of translations.
struct VoteBox {
  float low[3], high[3];
};

/// Copies the votes of the range that can be neighbours of a vote in the box to `to`, whose
/// columns are `stride` apart, and their numbers to `numbers`; returns how many. Both have room for
/// all and kScanPadding more.
std::size_t copy_near(const Kernel& kernel, const VoteColumns& columns, IndexRange range,
                      const VoteBox& box, float* to, std::size_t stride, std::uint32_t* numbers);

}  // namespace posevote
