// SPDX-License-Identifier: BSD-3-Clause
// Poses of different objects that claim the same part of a scan. A small flat thing fits anywhere in
// the side of a large one; taken by itself it may be as sure, but it leaves unsaid what the rest of
// the side is. And of parts that differ little, a bolt and a longer one, what they share is as good
// for either: where they differ decides.
#pragma once

#include <optional>

#include "nodes/geometry/near_surface.hpp"
#include "nodes/poses/candidate.hpp"
#include "nodes/poses/scan_state.hpp"

namespace posevote::poses {

/// A refined pose, and within which distance a scan point is its [m].
struct Claim {
  const Model& model;
  const geometry::SurfaceIndex& model_index;  ///< of its points
  const Candidate& candidate;
  float tolerance;
};

/// The log odds that `rival` is right and not `first`, where they explain the same of what is left of
/// the scan: by their confidences, by how much more it explains, and by what the scan says of the
/// surface that only one of them has (`terms`, of twins). Otherwise none.
std::optional<double> log_odds_over(const Claim& rival, const Claim& first, const ScanState& scan,
                                    const Terms& terms);

}  // namespace posevote::poses
