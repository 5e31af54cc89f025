// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/verdict.hpp"

#include <algorithm>
#include <array>

namespace posevote::explain {
namespace {

// Where figures fall short. Round numbers, chosen by hand and held against misses of real and
// simulated sets; they decide what a miss is called and nothing else.
constexpr double kHardlySeen = 0.15;       // of the points that face the sensor, on the scan
constexpr double kMostlyHidden = 0.55;     // of them, that say nothing
constexpr std::size_t kFewFeatures = 15;   // on the pose
constexpr double kFewMatched = 0.04;       // of these
constexpr std::size_t kFewAgreeing = 5;    // correspondences and pairs that vote for the pose
constexpr double kLikely = 0.06;           // confidence from which a candidate may be the object
constexpr double kForgiven = 0.8;          // what it has but for the clue that is most against it
constexpr std::size_t kManyAgreeing = 20;  // of a candidate, so that votes say it is there ...
constexpr double kNearHighest = 0.5;       // ... with a density of this share of the highest
constexpr double kOddSize = 30;            // x other objects
constexpr double kTooLarge = 3;            // x scan

/// Whether the pose was refined, and so judged, in the search.
bool was_judged(const Standing& at) {
  return std::any_of(at.way.begin(), at.way.end(),
                     [](const Place& place) { return place.step == "refine" && place.place > 0; });
}

std::string step_that_lost(const Standing& at) {
  return at.way.empty() || at.way.back().place > 0 ? "" : at.way.back().step;
}

std::string worst_clue(const Judged& judged) { return judged.reasons().front().first; }

/// Of what says nothing for the pose or against it, the most.
std::string why_unseen(const Seen& seen) {
  if (seen.hidden >= std::max(seen.outside, seen.unmeasured)) return "hidden";
  return seen.outside >= seen.unmeasured ? "outside" : "unmeasured";
}

bool is_unseen(const Seen& seen) {
  return seen.supported < kHardlySeen &&
         seen.hidden + seen.outside + seen.unmeasured > kMostlyHidden;
}

bool has_odd_size(const Case& of) {
  if (of.scan_size > 0 && of.diagonal > kTooLarge * of.scan_size) return true;
  return of.usual_size > 0 &&
         (of.diagonal > kOddSize * of.usual_size || kOddSize * of.diagonal < of.usual_size);
}

/// Of a pose that was judged, or would have been sure enough.
Verdict judge_refused(const Case& of, const Standing& at) {
  if (at.near_same && *at.near_same < of.nms_radius) return {Cause::kTooNear, "", ""};
  if (at.inside > of.overlap) return {Cause::kInside, "", ""};
  if (at.judged.confidence >= of.min_confidence && at.left.confidence < of.min_confidence &&
      at.taken > kMuchTaken)
    return {Cause::kTaken, at.taker, ""};
  return {Cause::kRefused, worst_clue(deciding(at, of)), ""};
}

bool would_do(const Case& of, const Standing& at) { return at.sureness() >= of.min_confidence; }

/// Before anybody looked at the pose: which stage gave too little. What was proposed had enough.
std::optional<Verdict> judge_proposal(const Standing& at) {
  if (at.rank > 0) return std::nullopt;
  if (at.features < kFewFeatures) return Verdict{Cause::kFewFeatures, "", ""};
  if (at.agreeing + at.pairs >= kFewAgreeing) return std::nullopt;
  if (static_cast<double>(at.matched) < kFewMatched * static_cast<double>(at.features))
    return Verdict{Cause::kNotMatched, at.other, ""};
  return Verdict{Cause::kDisagree, "", ""};
}

Verdict judge_true(const Case& of, const Standing& at) {
  if (was_judged(at) && would_do(of, at)) return {Cause::kMoved, "", ""};
  if (was_judged(at)) return judge_refused(of, at);
  // Little is seen of it, and what is seen would not do.
  if (is_unseen(at.seen) && !(at.rank > 0 && would_do(of, at)))
    return {Cause::kNotSeen, "", why_unseen(at.seen)};
  if (const auto early = judge_proposal(at)) return *early;
  if (!at.stayed) return {Cause::kMoved, "", ""};
  if (would_do(of, at)) return {Cause::kOutranked, step_that_lost(at), ""};
  return judge_refused(of, at);
}

/// Whether votes alone make it likely that the pose is the object: many, and next to none elsewhere.
bool is_voted_for(const Standing& at) {
  return at.agreeing + at.pairs >= kManyAgreeing && at.density >= kNearHighest * at.highest;
}

Verdict judge_candidate(const Case& of, const Standing& at) {
  const bool has_votes = at.rank > 0 || at.agreeing + at.pairs >= kFewAgreeing;
  if (has_votes && at.left.confidence >= of.min_confidence) {
    // What was refined near it was refused.
    if (was_judged(at)) return {Cause::kMoved, "", ""};
    return {Cause::kOutranked, step_that_lost(at), ""};
  }
  const Verdict refused = judge_refused(of, at);
  if (refused.cause != Cause::kRefused) return refused;
  const bool is_likely = (has_votes && at.likelihood() >= kLikely) ||
                         (is_voted_for(at) && at.judged.forgiven() >= kForgiven);
  if (is_likely && !is_unseen(at.seen)) return refused;
  return {Cause::kNoTrace, worst_clue(at.judged), ""};
}

}  // namespace

const Judged& deciding(const Standing& at, const Case& of) {
  const bool is_by_rest = at.judged.confidence >= of.min_confidence && at.left.score > 0;
  return is_by_rest ? at.left : at.judged;
}

const char* name_of(Cause cause) {
  constexpr auto kNames = std::to_array<const char*>(
      {"found", "scan failed", "model left out", "unit", "not seen", "few features", "not matched",
       "matches do not agree", "outranked", "moved by ICP", "points taken", "too near to another",
       "inside of others", "refused", "no trace", "absent"});
  static_assert(kNames.size() == static_cast<std::size_t>(Cause::kAbsent) + 1);
  return kNames[static_cast<std::size_t>(cause)];
}

Verdict judge_case(const Case& of) {
  if (of.is_found) return {Cause::kFound, "", ""};
  if (of.is_absent) return {Cause::kAbsent, "", ""};
  if (has_odd_size(of)) return {Cause::kUnit, "", ""};
  if (!of.pose) return {of.matches == 0 ? Cause::kNotMatched : Cause::kNoTrace, "", ""};
  return of.is_true ? judge_true(of, *of.pose) : judge_candidate(of, *of.pose);
}

}  // namespace posevote::explain
