// SPDX-License-Identifier: BSD-3-Clause
// Poses of different objects that claim the same part of a scan. A small flat thing fits anywhere in
// the side of a large one; taken by itself it may be as sure, but it leaves unsaid what the rest of
// the side is.
#pragma once

#include "nodes/geometry/near_surface.hpp"
#include "nodes/poses/candidate.hpp"
#include "nodes/poses/scan_state.hpp"

namespace posevote::poses {

/// A pose, and within which distance a scan point is its [m].
struct Claim {
  const Model& model;
  const geometry::SurfaceIndex& model_index;  ///< of its points
  const Candidate& candidate;
  float tolerance;
};

/// Whether `rival`, though no more confident than `first`, is the likelier of the two: they explain
/// the same of what is left of the scan, and it so much more that this outweighs the odds.
bool goes_before(const Claim& rival, const Claim& first, const ScanState& scan);

}  // namespace posevote::poses
