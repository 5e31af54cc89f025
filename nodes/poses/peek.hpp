// SPDX-License-Identifier: BSD-3-Clause
// What the range image alone says of a pose: a projection for each of a few points, not a search. It
// cannot tell a thin thing from the ground it lies on. But of the poses that chance proposes most
// stand before what the sensor saw, or where it saw nothing, and where noise spreads the votes of the
// true one, thousands go before it.
#pragma once

#include <cstddef>
#include <vector>

#include "nodes/data/hypotheses.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// Of proposals with these numbers, the best supported first, `glances` at most: the best by a
/// peek; in their order. The first where no single sensor saw the scan, and once something was taken
/// out of it, which the range image does not forget.
std::vector<std::size_t> worth_a_glance(const Sought& sought,
                                        const std::vector<Hypothesis>& proposals,
                                        const std::vector<std::size_t>& numbers);

}  // namespace posevote::poses
