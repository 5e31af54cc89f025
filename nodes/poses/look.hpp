// SPDX-License-Identifier: BSD-3-Clause
// A look at where an instance was in the frame before: the last steps of a search, refinement and
// judgement, for one pose that needs no votes.
#pragma once

#include "nodes/poses/candidate.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// The instance by the scan of another frame: refined from where it was, and judged as any other. Its
/// votes are those that it was found by, since nobody votes for it again.
Candidate look(const Sought& sought, const Candidate& before);

/// Judges it by the scan as it is now, from which others may have taken points.
void judge_again(const Sought& sought, Candidate& candidate);

}  // namespace posevote::poses
