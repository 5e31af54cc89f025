// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of the density: one vote against runs of others, as wide as the processor allows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/vote/kernel.hpp"

namespace posevote {

/// Other votes as seven arrays. Up to kScanPadding floats behind the last are read, not used.
struct VoteColumns {
  const float *tx, *ty, *tz, *qw, *qx, *qy, *qz;
};

constexpr std::size_t kScanPadding = 64;
constexpr std::uint32_t kMostWeights = 127;  ///< whose sum 32 bits hold

/// Votes begin to end - 1 of the columns, to be compared with `sign` times the query's quaternion.
struct ScanRange {
  std::uint32_t begin, end;
  float sign;
};

/// The sum over all votes of the ranges of their weights at the query, in units of 2^-25, where a
/// vote counts if it is near under its range's sign. Equals kernel_units bit for bit on every
/// processor. Where `back` is not null, each vote's weight is added to its place there, too, padded
/// as the columns are: the kernel is symmetric, and what a vote weighs at the query the query
/// weighs at the vote. After kMostWeights scans it must be emptied.
std::uint64_t scan_votes(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         const ScanRange* ranges, std::size_t range_count, std::uint32_t* back);

}  // namespace posevote
