// SPDX-License-Identifier: BSD-3-Clause
// The search for one object among the modes of its votes (nodes/poses), as segment_objects makes it;
// `posevote explain` makes the same to watch it.
#pragma once

#include "nodes/poses/segment_params.hpp"
#include "nodes/segment/live_votes.hpp"

namespace posevote::segment {

/// What is sought, and by which rules. Keeps references to all three.
poses::Sought sought_for(const LiveVotes& object, const poses::ScanState& scan,
                         const poses::SegmentParams& params);

/// The best vote of each correspondence and the single votes, with their densities, of what nothing
/// explained yet; the best first.
std::vector<Hypothesis> modes_of(const LiveVotes& object);

/// Modes as proposals: votes of what was explained since are taken out first. Keeps references.
poses::Proposals propose_from(LiveVotes& object, const poses::ScanState& scan,
                              const poses::Terms& terms);

}  // namespace posevote::segment
