// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/best_candidate.hpp"

#include <algorithm>

#include "tools/explain/verdict.hpp"

namespace posevote::explain {
namespace {

constexpr std::size_t kMostCandidates = 5;
/// Of a second candidate: on points of its own, and but for one clue as likely as not.
constexpr double kWorthNaming = 1.5;

/// The search with more of everything, which refines what the run's would have passed over.
poses::SegmentParams deeper(const poses::SegmentParams& params) {
  poses::SegmentParams more = params;
  poses::ScheduleTerms& schedule = more.terms.schedule;
  more.candidates = std::min(10000, 4 * params.candidates);
  schedule.shortlist = std::min(10000, 4 * schedule.shortlist);
  schedule.promising = schedule.finalists = std::max(150, schedule.promising);
  schedule.sketch_hopeless = schedule.closer_hopeless = schedule.hopeless = 0;
  schedule.sure = 1;
  return more;
}

void add_looked_at(const SearchWatch& search, std::size_t object, poses::Candidates& all) {
  for (const Step& step : search.steps(object))
    if (step.name == "refine")
      all.insert(all.end(), step.candidates.begin(), step.candidates.end());
  for (const auto* list : {&search.instances().rejected, &search.instances().found})
    for (const poses::Instance& one : *list)
      if (one.object == object) all.push_back(one.candidate);
}

poses::Candidates looked_at(const Bench& bench, std::size_t object) {
  const poses::SegmentParams more = deeper(bench.params);
  poses::Candidates all;
  add_looked_at(bench.search, object, all);
  add_looked_at(SearchWatch(bench.taps, more, object), object, all);
  add_looked_at(SearchWatch(bench.taps, more, object,
                            [&](poses::ScanState& scan) { bench.take_out_found(scan); }),
                object, all);
  return all;
}

/// What makes a pose the likelier answer to where a missed object is: to be sure and on points of
/// its own, to be sure but for others that have its points, to be sure but for one clue. A sure one
/// on the points of a found one of its kind is most likely that one.
double promise(const Bench& bench, std::size_t object, const poses::Candidate& candidate) {
  const Model& model = *bench.taps.votes[object].model;
  const Judged judged = judged_as(candidate, bench.params.terms);
  Standing at;
  at.T_scene_model = candidate.T_scene_model;
  bench.compare_found(object, Alike(model, candidate.T_scene_model), at);
  const bool is_sure = judged.confidence >= bench.params.min_confidence;
  if (at.taken <= kMuchTaken) return is_sure ? 3 + judged.confidence : 1 + judged.forgiven();
  return is_sure && at.taker != model.name ? 2 + judged.confidence : judged.confidence;
}

bool is_found(const Bench& bench, std::size_t object, const Eigen::Isometry3d& T_scene_model) {
  const Alike alike(*bench.taps.votes[object].model, T_scene_model);
  const auto& found = bench.search.instances().found;
  return std::any_of(found.begin(), found.end(), [&](const poses::Instance& one) {
    return one.object == object && alike.is_near(one.candidate.T_scene_model);
  });
}

}  // namespace

std::vector<Eigen::Isometry3d> best_candidates(const Bench& bench, std::size_t object) {
  const Model& model = *bench.taps.votes[object].model;
  std::vector<std::pair<double, Eigen::Isometry3d>> all;
  for (const poses::Candidate& one : looked_at(bench, object))
    if (!is_found(bench, object, one.T_scene_model))
      all.emplace_back(promise(bench, object, one), one.T_scene_model);
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const double apart = bench.params.nms * static_cast<double>(model.diagonal);
  std::vector<Eigen::Isometry3d> best;
  for (const auto& [promised, pose] : all) {
    if (best.size() == kMostCandidates || (!best.empty() && promised < kWorthNaming)) break;
    const Alike alike(model, pose);
    if (std::none_of(best.begin(), best.end(),
                     [&](const auto& other) { return alike.distance(other) <= apart; }))
      best.push_back(pose);
  }
  if (!best.empty()) return best;
  const std::vector<Hypothesis> modes = segment::modes_of(bench.objects[object]);
  if (!modes.empty()) best.push_back(T_scene_model_of(modes.front(), model.center));
  return best;
}

}  // namespace posevote::explain
