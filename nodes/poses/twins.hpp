// SPDX-License-Identifier: BSD-3-Clause
// A model that a motion carries nearly onto itself (a carton turned by half, a cup upside down)
// looks alike in two poses, which get each other's votes. Where such twins differ decides between
// them, together with their confidences, which also weigh what both have alike.
#pragma once

#include <vector>

#include "nodes/data/symmetries.hpp"
#include "nodes/poses/candidate.hpp"
#include "nodes/poses/pool.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// The best of a refined pose and its twins, one for each near symmetry of the model, refined too.
/// They share the hypothesis that proposed it; those at taken places do not compete. A twin that wins
/// is as probable as the pose was, within what tells: that the object is there they have in common.
Candidate best_alike(const Sought& sought, const Candidate& candidate, const TakenPlaces& taken);

/// Whether colours tell a refined pose from another one of the same place, and the whole of what is
/// known makes it more probable: a carton that lies as well on any of its sides.
bool is_better_by_color(const Sought& sought, const Candidate& rival, const Candidate& best);

/// The poses that near symmetries of the model make of a refined one and the scan does not tell
/// from it for sure, because what differs is hidden or lost in noise; the likeliest first. What their
/// probabilities leave of 1 is the pose's own, and a trifle of those that are left out.
std::vector<LookAlike> look_alikes(const Sought& sought, const Candidate& candidate);

/// What a lead of so many standard deviations adds to the log odds. It counts up to what tells: points
/// err alike, so more of it is no surer.
double log_odds_of_lead(double lead, const TwinTerms& terms);

/// How much more the scan speaks for a twin than for the pose that a near symmetry made it of,
/// where they differ, in standard deviations, were the points independent.
double lead_over(const Sought& sought, const Candidate& origin, const Candidate& twin);

}  // namespace posevote::poses
