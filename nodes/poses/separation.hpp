// SPDX-License-Identifier: BSD-3-Clause
// Which proposed poses are the same, by where the model's centre lands and how it is turned. A
// place may stand in for several quite different rotations: an upside-down cup is proposed where
// the upright one is, and may have more support.
#pragma once

#include <cstddef>
#include <vector>

#include "nodes/data/hypotheses.hpp"

namespace posevote::poses {

/// How far poses lie apart.
struct Separation {
  float distance;  ///< of their centres, unless they are turned [m]
  float angle;     ///< by more than this [rad],
  int per_place;   ///< at most so many
};

/// Whether two poses are not apart.
bool is_like(const Hypothesis& a, const Hypothesis& b, const Separation& separation);

/// Non-maximum suppression: the numbers of the first `count` poses that are separate from all of
/// those before.
std::vector<std::size_t> separate_poses(const std::vector<Hypothesis>& poses,
                                        const Separation& separation, std::size_t count);

}  // namespace posevote::poses
