// SPDX-License-Identifier: BSD-3-Clause
// Settings that may help, tried: advice that is not tried is a guess.
#pragma once

#include <string>
#include <vector>

#include "tools/explain/explain.hpp"

namespace posevote::explain {

/// Settings that act on the stage which lost the object, from the figures; the mildest first.
/// `resolution`: what the scan resolves [m], 0: not known.
std::vector<std::string> settings_for(const Explained& one, const poses::SegmentParams& params,
                                      double resolution);

/// Runs the scan again by each of them, up to the first that finds the object: near its true pose,
/// where that is known, else where none of it was found before.
std::vector<Attempt> attempt(const Explained& one, const Taps& taps);

}  // namespace posevote::explain
