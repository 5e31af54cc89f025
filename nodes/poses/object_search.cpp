// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/object_search.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/poses/color_turns.hpp"
#include "nodes/poses/pose_covariance.hpp"
#include "nodes/poses/refinement.hpp"
#include "nodes/poses/score.hpp"
#include "nodes/poses/twins.hpp"

namespace posevote::poses {
namespace {

/// Adds the time of its life to `sum` [s].
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

ObjectSearch::ObjectSearch(const Sought& sought, Proposals proposals)
    : sought_(sought), proposals_(std::move(proposals)), taken_(sought.params.nms_radius) {}

bool ObjectSearch::may_propose() const {
  if (is_full() || proposed_at_ == sought_.scan.takes) return false;
  const bool took_few =
      sought_.params.candidates <= static_cast<std::size_t>(sought_.terms.schedule.shortlist);
  return proposed_at_ < 0 || accepted_ > 0 || took_few;
}

void ObjectSearch::propose() {
  {
    const Stopwatch watch(seconds_);
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
  }
  proposed_at_ = sought_.scan.takes;
  choose();
}

void ObjectSearch::choose() {
  const std::size_t before = refused_.size();
  {
    const Stopwatch watch(seconds_);
    choose_best();
  }
  if (best_) best_->seconds = seconds_;
  if (refused_.size() > before) refused_.back().seconds = seconds_;
}

void ObjectSearch::choose_best() {
  chosen_at_ = sought_.scan.takes;
  bring_finalists_forward(sought_, pool_);
  show("look", pool_);
  best_ = best_finalist();
  if (best_) {
    show("choose", {*best_});
    const bool is_promising = is_convincing(sought_, *best_);
    if (is_promising) polish(sought_, *best_);
    best_->symmetries = symmetries_left(sought_, *best_);
    const bool is_clear = taken_.is_clear(sought_, best_->T_scene_model);
    if (is_clear && is_promising && is_convincing(sought_, *best_)) {
      best_->covariance = pose_covariance(sought_, best_->T_scene_model);
      best_->look_alikes = look_alikes(sought_, *best_);
      return;
    }
    if (is_clear) refused_.push_back(*best_);
  }
  best_.reset();
  pool_.clear();
}

/// Finalists that ICP carries onto instances that are found already leave the pool, and the next
/// take their places. So they do, once, where those that were refined convince nobody: ranks of
/// before ICP may err.
std::optional<Candidate> ObjectSearch::best_finalist() {
  std::optional<Candidate> doubtful;
  while (!pool_.empty() && (!doubtful || may_win(sought_, pool_[0]))) {
    const Candidates::iterator end = refine_best(sought_, pool_);
    if (end == pool_.begin()) break;
    std::ranges::stable_sort(pool_.begin(), end, std::greater(), &Candidate::confidence);
    if (sought_.watch) show("refine", {pool_.begin(), end});
    const std::optional<Candidate> best = best_of(pool_.begin(), end);
    if (best && is_convincing(sought_, *best)) return best_of_place(*best);
    if (doubtful) break;
    doubtful = best;
    pool_.erase(pool_.begin(), end);
  }
  return doubtful;
}

/// Of refined poses, the first that reaches the threshold, itself or the twin that
/// is better than it; if none does, what is best of the first, because a twin may reach it.
std::optional<Candidate> ObjectSearch::best_of(Candidates::const_iterator begin,
                                               Candidates::const_iterator end) const {
  const Candidate* first = nullptr;
  for (auto candidate = begin; candidate != end; ++candidate) {
    if (!taken_.is_clear(sought_, candidate->T_scene_model)) continue;
    if (!is_convincing(sought_, *candidate)) {
      if (!first) first = &*candidate;
      continue;
    }
    Candidate best = best_alike(sought_, *candidate, taken_);
    for (auto rival = std::next(candidate); rival != end; ++rival)
      if (is_better_by_color(sought_, *rival, best)) best = *rival;
    if (is_convincing(sought_, best)) return best;
  }
  if (!first) return std::nullopt;
  return best_alike(sought_, *first, taken_);
}

/// Once `best` is an instance, its place is closed to whatever else was proposed there; so the first
/// of those that were no finalists are refined before.
Candidate ObjectSearch::best_of_place(const Candidate& best) const {
  const auto center = [&](const Candidate& one) {
    return posed_center(one.T_scene_model, sought_.model.center);
  };
  const auto most = static_cast<std::size_t>(sought_.terms.schedule.finalists);
  Candidates others;
  for (const Candidate& one : pool_)
    if (others.size() < most && !one.is_refined && may_win(sought_, one) &&
        (center(one) - center(best)).norm() < static_cast<double>(sought_.params.nms_radius))
      others.push_back(one);
  graph::parallel_for(others.size(), 1, [&](std::size_t i) { refine(sought_, others[i]); });
  std::erase_if(others, [&](const Candidate& one) { return one.confidence <= best.confidence; });
  std::ranges::stable_sort(others, std::greater(), &Candidate::confidence);
  const std::optional<Candidate> better = best_of(others.begin(), others.end());
  return better && is_convincing(sought_, *better) ? *better : best;
}

void ObjectSearch::accept(const Candidate& known) {
  taken_.take(sought_.model, known);
  ++accepted_;
}

void ObjectSearch::accept() {
  accept(*best_);
  seconds_ = 0;
  best_.reset();
  std::erase_if(pool_, [this](const Candidate& other) {
    return is_full() || !taken_.is_clear(other.proposed.center);
  });
}

}  // namespace posevote::poses
