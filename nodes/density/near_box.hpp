// SPDX-License-Identifier: BSD-3-Clause
// Which votes are near a box of others: those alone need be weighed against what lies in it.
#pragma once

#include "nodes/density/scan_votes.hpp"

namespace posevote::density {

/// Bounding box of translations.
struct VoteBox {
  float low[3], high[3];
};

/// The box around a range that is not empty.
VoteBox bounding_box(const VoteColumns& votes, IndexRange range);

/// Copies the votes of the range that can be neighbours of a vote in the box to `to`, whose
/// columns are `stride` apart, and their numbers to `numbers`; returns how many. Both have room for
/// all and kScanPadding more.
std::size_t copy_near(const Kernel& kernel, const VoteColumns& columns, IndexRange range,
                      const VoteBox& box, float* to, std::size_t stride, std::uint32_t* numbers);

}  // namespace posevote::density
