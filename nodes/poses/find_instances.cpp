// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/find_instances.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "graph/parallel.hpp"
#include "nodes/poses/confidence.hpp"
#include "nodes/poses/contest.hpp"

namespace posevote::poses {
namespace {

using Searches = std::vector<ObjectSearch*>;

Searches sorted_by_id(std::vector<ObjectSearch>& searches) {
  Searches sorted;
  for (ObjectSearch& search : searches) sorted.push_back(&search);
  std::stable_sort(sorted.begin(), sorted.end(), [](const ObjectSearch* a, const ObjectSearch* b) {
    return a->model().obj_id < b->model().obj_id;
  });
  return sorted;
}

/// Where other poses may be proposed, they are. False if nowhere.
bool propose(const Searches& searches) {
  Searches open;
  for (ObjectSearch* search : searches)
    if (search->may_propose()) open.push_back(search);
  graph::parallel_for(open.size(), 1, [&](std::size_t i) { open[i]->propose(); });
  return !open.empty();
}

/// What a search has to offer is claimed as far as what is supported.
Claim claim_of(const ObjectSearch& search, const Candidate& pose) {
  return {search.model(), search.model_index(), pose, search.params().tolerance};
}

Claim claim_of(const ObjectSearch& search) { return claim_of(search, *search.best()); }

ObjectSearch* most_confident(const Searches& searches) {
  ObjectSearch* best = nullptr;
  for (ObjectSearch* search : searches)
    if (search->best() && (!best || search->best()->confidence > best->best()->confidence))
      best = search;
  return best;
}

/// Of a pose of another object that would be a detection, the log odds that it is right and not
/// what `first` has; none where they are no rivals.
std::optional<double> odds_of_rival(const ObjectSearch& rival, const ObjectSearch& first,
                                    const ScanState& scan) {
  if (&rival == &first || !rival.best() || rival.best()->confidence < rival.params().min_confidence)
    return std::nullopt;
  return log_odds_over(claim_of(rival), claim_of(first), scan, first.terms());
}

/// The one that goes before `best`, or that.
ObjectSearch* ahead_of(ObjectSearch* best, const Searches& searches, const ScanState& scan) {
  ObjectSearch* ahead = best;
  for (ObjectSearch* rival : searches)
    if (odds_of_rival(*rival, *ahead, scan).value_or(0) > 0) ahead = rival;
  return ahead;
}

/// The one that has a pose where `best` has its own, though not its best, and goes before it, or
/// that. What was taken out since may have uncovered it.
ObjectSearch* ahead_there(ObjectSearch* best, const Searches& searches, const ScanState& scan) {
  const Claim claim = claim_of(*best);
  if (claim.candidate.confidence >= best->terms().schedule.sure) return best;
  const Eigen::Vector3d center = posed_center(claim.candidate.T_scene_model, claim.model.center);
  std::vector<Candidates> others(searches.size());
  graph::parallel_for(searches.size(), 1, [&](std::size_t i) {
    const float smaller = std::min(searches[i]->model().diagonal, claim.model.diagonal);
    if (searches[i] != best)
      others[i] = searches[i]->look_near(center, static_cast<double>(smaller / 2));
  });
  double most = 0;
  ObjectSearch* ahead = nullptr;
  const Candidate* pose = nullptr;
  for (std::size_t i = 0; i < searches.size(); ++i)
    for (const Candidate& other : others[i]) {
      const double odds =
          log_odds_over(claim_of(*searches[i], other), claim, scan, best->terms()).value_or(0);
      if (odds <= most) continue;
      most = odds;
      ahead = searches[i];
      pose = &other;
    }
  return ahead && ahead->prefer(*pose) ? ahead : best;
}

/// The probability that what `chosen` has is this object, if it is one of those that claim the
/// same. What speaks for another was outweighed when it was chosen.
double probability_of_identity(const ObjectSearch& chosen, const Searches& searches,
                               const ScanState& scan) {
  double others = 0;
  for (const ObjectSearch* rival : searches)
    if (const auto odds = odds_of_rival(*rival, chosen, scan))
      others += std::exp(std::min(*odds, 0.0));
  return 1 / (1 + others);
}

/// The search that has the best pose for the scan as it is now; null if none has any. What was
/// judged before is an upper bound, so most of them need no second look.
ObjectSearch* best_of(const Searches& searches, const ScanState& scan) {
  for (;;) {
    ObjectSearch* best = most_confident(searches);
    if (best && best->is_current()) best = ahead_of(best, searches, scan);
    if (!best) return nullptr;
    if (best->is_current()) return ahead_there(best, searches, scan);
    best->choose();
  }
}

/// With those that are doubtful.
std::vector<Instance> search_all(std::vector<ObjectSearch>& searches, ScanState& scan) {
  const Searches sorted = sorted_by_id(searches);
  std::vector<Instance> found;
  // When all that was proposed is used up, what was taken out may have uncovered other modes.
  while (propose(sorted))
    while (ObjectSearch* search = best_of(sorted, scan)) {
      Instance& instance = found.emplace_back(
          Instance{static_cast<std::size_t>(search - searches.data()), *search->best()});
      doubt_as_stranger(scan.known, search->terms(), instance.candidate);
      instance.candidate.identity = probability_of_identity(*search, sorted, scan);
      search->accept();
      if (std::all_of(sorted.begin(), sorted.end(),
                      [](const ObjectSearch* s) { return s->is_full(); }))
        return found;
      const Eigen::Isometry3d& T_scene_model = instance.candidate.T_scene_model;
      scan.take_out(search->model(), T_scene_model, search->params().explained_distance);
      scan.learn_from(search->model(), instance.candidate);
      search->choose();
    }
  return found;
}

std::vector<Member> members_of(std::vector<Instance>& instances,
                               const std::vector<ObjectSearch>& searches) {
  std::vector<Member> members;
  for (Instance& one : instances)
    members.push_back(
        {searches[one.object].model().obj_id, searches[one.object].terms(), one.candidate});
  return members;
}

void sort_by_confidence(std::vector<Instance>& instances) {
  std::stable_sort(instances.begin(), instances.end(), [](const Instance& a, const Instance& b) {
    return a.candidate.confidence > b.candidate.confidence;
  });
}

/// The first of each object, and of those in one place.
void keep_few(std::vector<Instance>& instances, const std::vector<ObjectSearch>& searches) {
  constexpr std::size_t kFew = 3;
  std::vector<std::vector<Eigen::Vector3d>> kept(searches.size());
  std::erase_if(instances, [&](const Instance& instance) {
    const ObjectSearch& search = searches[instance.object];
    const Eigen::Vector3d center =
        posed_center(instance.candidate.T_scene_model, search.model().center);
    std::vector<Eigen::Vector3d>& others = kept[instance.object];
    const bool is_new = std::none_of(others.begin(), others.end(), [&](const auto& other) {
      return (other - center).norm() < static_cast<double>(search.params().nms_radius);
    });
    if (!is_new || others.size() == kFew) return true;
    others.push_back(center);
    return false;
  });
}

}  // namespace

Instances find_instances(std::vector<ObjectSearch>& searches, ScanState& scan) {
  const Acquaintance before = scan.known;
  Instances all;
  all.found = search_all(searches, scan);
  believe_in_company(members_of(all.found, searches), before);
  const auto doubtful =
      std::stable_partition(all.found.begin(), all.found.end(), [&](const Instance& instance) {
        return instance.candidate.confidence >= searches[instance.object].params().min_confidence;
      });
  all.rejected.assign(doubtful, all.found.end());
  all.found.erase(doubtful, all.found.end());
  for (std::size_t i = 0; i < searches.size(); ++i)
    for (const Candidate& refused : searches[i].refused()) {
      Instance& one = all.rejected.emplace_back(Instance{i, refused, false});
      doubt_as_stranger(scan.known, searches[i].terms(), one.candidate);
    }
  sort_by_confidence(all.found);
  sort_by_confidence(all.rejected);
  keep_few(all.rejected, searches);
  return all;
}

}  // namespace posevote::poses
