// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/object_search.hpp"

#include <utility>

#include "nodes/poses/refinement.hpp"
#include "nodes/poses/score.hpp"
#include "nodes/poses/twins.hpp"

namespace posevote::poses {

ObjectSearch::ObjectSearch(const Sought& sought, Proposals proposals)
    : sought_(sought), proposals_(std::move(proposals)), taken_(sought.params.nms_radius) {}

void ObjectSearch::propose() {
  pool_ = collect(sought_, proposals_.propose(), taken_);
  show("propose", pool_);
  make_shortlist(sought_, pool_);
  show("glance", pool_);
  sketch(sought_, pool_, proposals_.improve);
  show("sketch", pool_);
  leave_out_likes(sought_, pool_);
  show("leave out likes", pool_);
  bring_closer(sought_, pool_);
  show("bring closer", pool_);
  proposed_at_ = sought_.scan.takes;
  choose();
}

void ObjectSearch::choose() {
  chosen_at_ = sought_.scan.takes;
  bring_finalists_forward(sought_, pool_);
  show("look", pool_);
  best_ = best_finalist();
  if (best_) show("choose", {*best_});
  if (best_ && is_convincing(sought_, *best_)) {
    polish(sought_, *best_);
    if (is_convincing(sought_, *best_) && taken_.is_clear(sought_.model, best_->T_scene_model))
      return;
  }
  if (best_ && taken_.is_clear(sought_.model, best_->T_scene_model)) refused_.push_back(*best_);
  best_.reset();
  pool_.clear();
}

/// Finalists that ICP carries onto instances that are found already leave the pool, and the next
/// take their places.
std::optional<Candidate> ObjectSearch::best_finalist() {
  while (!pool_.empty()) {
    const Candidates::iterator end = refine_best(sought_, pool_);
    if (end == pool_.begin()) break;
    sort_by_rank(pool_.begin(), end);
    if (sought_.watch) show("refine", {pool_.begin(), end});
    if (auto best = best_of(pool_.begin(), end)) return best;
    pool_.erase(pool_.begin(), end);
  }
  return std::nullopt;
}

/// Of refined poses, the first that reaches the threshold by its quality, itself or the twin that
/// is better than it; if none does, what is best of the first, because a twin may reach it.
std::optional<Candidate> ObjectSearch::best_of(Candidates::const_iterator begin,
                                               Candidates::const_iterator end) const {
  const Candidate* first = nullptr;
  for (auto candidate = begin; candidate != end; ++candidate) {
    if (!taken_.is_clear(sought_.model, candidate->T_scene_model)) continue;
    if (!is_convincing(sought_, *candidate)) {
      if (!first) first = &*candidate;
      continue;
    }
    Candidate best = best_alike(sought_, *candidate, taken_);
    if (is_convincing(sought_, best)) return best;
  }
  if (!first) return std::nullopt;
  return best_alike(sought_, *first, taken_);
}

void ObjectSearch::accept() {
  taken_.take(sought_.model, *best_);
  ++accepted_;
  best_.reset();
  std::erase_if(pool_, [this](const Candidate& other) {
    return is_full() || !taken_.is_clear(other.proposed.center);
  });
}

}  // namespace posevote::poses
