// SPDX-License-Identifier: BSD-3-Clause
// A can looks the same from all around, but for its label: of the turns after which a model has the
// same shape, the one whose colours agree best with what is seen.
#pragma once

#include "nodes/poses/candidate.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// Turns a pose by one of its model's symmetries where colours tell so, and measures its colours.
/// Balls are not turned: about any axis is too many.
void turn_by_color(const Sought& sought, Candidate& candidate);

/// Those of the model's symmetries after which the colours agree about as well as in this pose.
Symmetries symmetries_left(const Sought& sought, const Candidate& candidate);

}  // namespace posevote::poses
