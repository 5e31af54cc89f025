// SPDX-License-Identifier: BSD-3-Clause
// ICP on candidates, in three steps of rising exactness. Where params.refine is false, none moves.
#pragma once

#include "nodes/poses/candidate.hpp"
#include "nodes/poses/score.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// A pose that its votes miss by ten degrees fits no better than a wrong one, until it has taken
/// the first few steps. Kept wherever they lead: judging it again tells.
void take_first_steps(const Sought& sought, Candidate& candidate);

/// By its fit, by what is believed of it and, where that leaves it a chance, by how exact it is.
void judge_closely(const Sought& sought, Candidate& candidate, const Closeness& look);

/// Near enough to choose by, and judged closely. Moves it once only: what is taken out of the scan
/// later moves no pose. This and the next try its contour, too, where free space speaks against it.
void refine(const Sought& sought, Candidate& candidate);

/// As exact as the scan allows, and judged by all points, for the pose that is chosen.
void polish(const Sought& sought, Candidate& candidate);

}  // namespace posevote::poses
