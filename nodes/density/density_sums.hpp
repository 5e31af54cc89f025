// SPDX-License-Identifier: BSD-3-Clause
// Sums of kernel weights: of all votes of one sorted set at every vote of another.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/density/sorted_votes.hpp"

namespace posevote::density {

/// At every query the sum of the weights of its neighbours among `others`, in units (kWeightUnits)
/// and in the order of `queries`. Both sets have the same bandwidth. Parallel over the queries.
std::vector<std::uint64_t> density_sums(const SortedVotes& queries, const SortedVotes& others);

/// The same of one set at its own votes. Each pair of votes is looked at once.
std::vector<std::uint64_t> density_sums(const SortedVotes& votes);

}  // namespace posevote::density
