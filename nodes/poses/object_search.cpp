// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/object_search.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
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

void show(const Sought& sought, const char* step, const Candidates& candidates) {
  if (sought.watch) sought.watch(step, candidates);
}

/// From what was collected to the order in which they may be finalists.
void sift(const Sought& sought, Candidates& pool, const Improve& improve, int places) {
  make_shortlist(sought, pool, places);
  show(sought, "glance", pool);
  sketch(sought, pool, improve);
  show(sought, "sketch", pool);
  leave_out_likes(sought, pool);
  show(sought, "leave out likes", pool);
  bring_closer(sought, pool);
  show(sought, "bring closer", pool);
}

}  // namespace

ObjectSearch::ObjectSearch(const Sought& sought, Proposals proposals)
    : sought_(sought), proposals_(std::move(proposals)), taken_(sought.params.nms_radius) {}

bool ObjectSearch::may_propose() const {
  if (is_full() || proposed_at_ == sought_.scan.takes) return false;
  return !convinced_nobody() || sought_.terms.schedule.shortlist_again > 0;
}

bool ObjectSearch::convinced_nobody() const { return proposed_at_ >= 0 && accepted_ == 0; }

void ObjectSearch::propose() {
  const ScheduleTerms& terms = sought_.terms.schedule;
  const bool again = convinced_nobody();
  {
    const Stopwatch watch(seconds_);
    proposed_ = proposals_.propose();
    pool_ = collect(sought_, proposed_, taken_);
    if (again && std::ssize(pool_) > terms.shortlist)
      pool_.resize(static_cast<std::size_t>(terms.shortlist));
    show(sought_, "peek", pool_);
    sift(sought_, pool_, proposals_.improve, again ? terms.shortlist_again : terms.shortlist);
    // It was told already why nobody convinced.
    if (again) std::erase_if(pool_, [&](const Candidate& one) { return !may_win(sought_, one); });
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
  show(sought_, "look", pool_);
  best_ = best_finalist();
  if (best_) {
    show(sought_, "choose", {*best_});
    if (settle(*best_)) return;
    if (taken_.is_clear(sought_, best_->T_scene_model)) refused_.push_back(*best_);
  }
  best_.reset();
  pool_.clear();
}

/// Makes it exact, and adds what is told of a detection; false where it is none.
bool ObjectSearch::settle(Candidate& chosen) const {
  const bool is_promising = is_convincing(sought_, chosen);
  if (is_promising) polish(sought_, chosen);
  chosen.symmetries = symmetries_left(sought_, chosen);
  if (!is_promising || !is_convincing(sought_, chosen)) return false;
  if (!taken_.is_clear(sought_, chosen.T_scene_model)) return false;
  chosen.covariance = pose_covariance(sought_, chosen.T_scene_model);
  chosen.look_alikes = look_alikes(sought_, chosen);
  return true;
}

Candidates ObjectSearch::look_near(const Eigen::Vector3d& point, double distance) {
  if (is_full()) return {};
  const Stopwatch watch(seconds_);
  std::vector<Hypothesis> all = proposals_.propose(), there;
  taken_.leave_clear(all);
  std::ranges::copy_if(all, std::back_inserter(there), [&](const Hypothesis& one) {
    return (one.center.cast<double>() - point).norm() <= distance;
  });
  Sought near = sought_;  // for support is compared among these
  near.watch = {};
  Candidates pool = collect(near, std::move(there), taken_);
  for (Candidate& one : pool)
    one.elsewhere = support_elsewhere(all, one.proposed.center, near.model);
  sift(near, pool, proposals_.improve, near.terms.schedule.shortlist);
  bring_finalists_forward(near, pool);
  std::erase_if(pool, [&](const Candidate& one) { return !may_win(near, one); });
  pool.erase(refine_best(near, pool), pool.end());
  std::erase_if(pool, [&](const Candidate& one) {
    return one.confidence < near.params.min_confidence || !taken_.is_clear(near, one.T_scene_model);
  });
  return pool;
}

bool ObjectSearch::prefer(Candidate other) {
  {
    const Stopwatch watch(seconds_);
    if (!settle(other)) return false;
  }
  best_ = std::move(other);
  best_->seconds = seconds_;
  chosen_at_ = sought_.scan.takes;
  return true;
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
    if (sought_.watch) show(sought_, "refine", {pool_.begin(), end});
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
/// of those that were no finalists are refined before, unless it is sure.
Candidate ObjectSearch::best_of_place(const Candidate& best) const {
  if (best.confidence >= sought_.terms.schedule.sure) return best;
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
  least_support_ = std::min(least_support_, best_->proposed.support);
  seconds_ = 0;
  best_.reset();
  std::erase_if(pool_, [this](const Candidate& other) {
    return is_full() || !taken_.is_clear(other.proposed.center);
  });
  // What is left leads over what is left, and need not lead over more than the least of the
  // instances: of a bin's many, those on top have far more votes than those below.
  taken_.leave_clear(proposed_);
  for (Candidate& one : pool_)
    one.elsewhere =
        std::max(least_support_, support_elsewhere(proposed_, one.proposed.center, sought_.model));
}

}  // namespace posevote::poses
