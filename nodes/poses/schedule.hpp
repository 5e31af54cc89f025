// SPDX-License-Identifier: BSD-3-Clause
// Who gets how much attention: the fewer poses are left, the more is spent on each.
//
//   step             how many                    judged by
//   peek             all that were collected,    50 model points, by the range image alone, before
//                    4000                        anything is taken out of the scan
//   glance           the best of these, 600      the same, by the nearest points of the scan, with
//                    (160)                       twice the tolerance, as proposals lie off by part
//                                                of a bandwidth
//   sketch           the shortlist, 160 (10),    300, after their proposer improved them
//                    if not far behind
//   bring closer     the promising, 40, if not   300, after the first steps of ICP
//                    far behind
//   look             those that may be finalists 1000
//   refine           the finalists, 4, and twins 4000, after ICP
//   polish           the one that is chosen      all points, after ICP by ten thousand
//
// In brackets: of an object that convinced nobody when more was in the scan. The numbers are
// ScheduleTerms and RefinementTerms.
#pragma once

#include <functional>

#include "nodes/poses/candidate.hpp"
#include "nodes/poses/score.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// Makes a proposal on the shortlist better, before ICP; its support stays.
using Improve = std::function<Hypothesis(const Hypothesis&)>;

/// Judges part of the pool and sorts all up to its end.
void judge_part(const Sought& sought, Candidates& pool, std::size_t begin, std::size_t end,
                const Closeness& look);

/// Keeps as many as there are `places`, by a glance if there are more; then none far behind the best.
void make_shortlist(const Sought& sought, Candidates& pool, int places);

/// Improves them all, and judges and sorts them by a sketch.
void sketch(const Sought& sought, Candidates& pool, const Improve& improve);

/// Those that are promising take the first steps of ICP and are sketched again.
void bring_closer(const Sought& sought, Candidates& pool);

/// Looks at as many as may be finalists, which come to the front, and drops those of no quality.
/// Ranks of before something was taken out of the scan, and of sketches, are taken as upper bounds.
void bring_finalists_forward(const Sought& sought, Candidates& pool);

/// Whether ICP may make a detection of what was looked at.
bool may_win(const Sought& sought, const Candidate& candidate);

/// Refines the first of a sorted list, and of those behind as many as may turn out the best, which
/// come forward. Returns their end.
Candidates::iterator refine_best(const Sought& sought, Candidates& sorted);

}  // namespace posevote::poses
