// SPDX-License-Identifier: BSD-3-Clause
// Of an object's instances that were not found, the poses that may be they.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/explain/standing.hpp"

namespace posevote::explain {

/// Of the poses that were looked at closely by the run's search, and by two with more of everything
/// for this object alone, one in the whole scan and one in what the found instances left: the
/// likeliest, and others in other places that are likely, too, up to five. Empty where the object
/// has no votes.
std::vector<Eigen::Isometry3d> best_candidates(const Bench& bench, std::size_t object);

}  // namespace posevote::explain
