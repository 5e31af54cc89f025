// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/look.hpp"

#include "nodes/poses/confidence.hpp"
#include "nodes/poses/refinement.hpp"
#include "nodes/poses/score.hpp"

namespace posevote::poses {
namespace {

/// What votes said of it stands.
void recall_votes(const Sought& sought, const Candidate& before, Candidate& now) {
  if (!(now.quality > 0)) return;
  now.consensus = before.consensus;
  now.clues[kVotes] = before.clues[kVotes];
  now.clues[kLead] = before.clues[kLead];
  now.confidence = confidence_of(now, sought.terms);
}

}  // namespace

Candidate look(const Sought& sought, const Candidate& before) {
  Candidate now = before;
  now.proposed = hypothesis_of(before.T_scene_model, sought.model.center, before.proposed.support);
  now.is_refined = false;
  refine(sought, now);
  polish(sought, now);
  recall_votes(sought, before, now);
  return now;
}

void judge_again(const Sought& sought, Candidate& candidate) {
  const Candidate before = candidate;
  judge_closely(sought, candidate, kAllPoints);
  recall_votes(sought, before, candidate);
}

}  // namespace posevote::poses
