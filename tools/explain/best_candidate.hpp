// SPDX-License-Identifier: BSD-3-Clause
// Of an object that was not found, the pose that may be it.
#pragma once

#include <cstddef>
#include <optional>

#include "tools/explain/standing.hpp"

namespace posevote::explain {

/// Of the poses that were looked at closely by the run's search, and by two with more of everything
/// for this object alone, one in the whole scan and one in what the found instances left. Nothing
/// where the object has no votes.
std::optional<Eigen::Isometry3d> best_candidate(const Bench& bench, std::size_t object);

}  // namespace posevote::explain
