// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/find_instances.hpp"

#include <algorithm>

#include "graph/parallel.hpp"

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

/// The search that has the best pose for the scan as it is now; null if none has any. What was
/// judged before is an upper bound, so most of them need no second look.
ObjectSearch* best_of(const Searches& searches) {
  for (;;) {
    ObjectSearch* best = nullptr;
    for (ObjectSearch* search : searches)
      if (search->best() && (!best || search->best()->confidence > best->best()->confidence))
        best = search;
    if (!best || best->is_current()) return best;
    best->choose();
  }
}

/// With those that are doubtful.
std::vector<Instance> search_all(std::vector<ObjectSearch>& searches, ScanState& scan) {
  const Searches sorted = sorted_by_id(searches);
  std::vector<Instance> found;
  // When all that was proposed is used up, what was taken out may have uncovered other modes.
  while (propose(sorted))
    while (ObjectSearch* search = best_of(sorted)) {
      const Instance& instance = found.emplace_back(
          Instance{static_cast<std::size_t>(search - searches.data()), *search->best()});
      search->accept();
      if (std::all_of(sorted.begin(), sorted.end(),
                      [](const ObjectSearch* s) { return s->is_full(); }))
        return found;
      const Eigen::Isometry3d& T_scene_model = instance.candidate.T_scene_model;
      scan.take_out(search->model(), T_scene_model, search->params().explained_distance);
      if (instance.candidate.confidence >= search->params().min_confidence)
        scan.usual_residual.add(instance.candidate.fit,
                                scan.range_of(search->model(), T_scene_model));
      search->choose();
    }
  return found;
}

}  // namespace

std::vector<Instance> find_instances(std::vector<ObjectSearch>& searches, ScanState& scan) {
  std::vector<Instance> found = search_all(searches, scan);
  std::erase_if(found, [&](const Instance& instance) {
    return instance.candidate.confidence < searches[instance.object].params().min_confidence;
  });
  return found;
}

}  // namespace posevote::poses
