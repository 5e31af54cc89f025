// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/object_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/segment/refine_mode.hpp"

namespace posevote::segment {
namespace {

constexpr std::size_t kShortlist = 80;  // improved, judged by kSketch model points
constexpr std::size_t kPromising = 20;  // brought closer by coarse ICP, judged by kSketch again
constexpr std::size_t kFinalists = 4;   // refined by ICP, judged by kClose
constexpr Eigen::Index kGlance = 50;    // model points that judge a proposal as it came
constexpr Eigen::Index kSketch = 300;   // ... an improved one
constexpr Eigen::Index kLook = 1000;    // ... one of those that may be a finalist
constexpr Eigen::Index kClose = 4000;   // ... a refined one
constexpr Eigen::Index kCoarseSamples = 100, kIcpSamples = 1000, kPolishSamples = 10000;
constexpr int kCoarseSteps = 4;
constexpr double kCoarseStill = 0.1;   // of the tolerance
constexpr double kIcpStill = 0.02;     // of the tolerance
constexpr double kKeptSupport = 0.95;  // ICP may lose a few chance partners at the silhouette
constexpr double kHopeless = 0.25;     // of what is needed: ICP seldom raises a score fourfold

// Standard deviations, were the points independent, by which one of two poses that look alike must
// lead where they differ.
constexpr double kTelling = 2;

// A mode of a hundredth of the best one's density needs a score 1.6 times as high to be preferred:
// votes and fit are evidence of their own, but true instances differ much in how much of them is
// seen.
constexpr double kTrustInSupport = 0.1;

// Weight of the consensus in the score, measured on simulated and real RGB-D scans: support per
// feature on the posed model is 0.2 .. 1.2 for true poses, seldom below 0.05, and 0.02 .. 0.1 for
// shapes that only look alike from one side, where each casts 60 votes. The fit tells how much of
// the surface is there, the consensus how many of the features on it had voted for the pose before
// anybody looked.
constexpr double kTrustInConsensus = 0.15;
constexpr double kUsualVotes = 60;

// Of the tolerance: so much the points' own distances may leave where there is no noise.
constexpr double kSampled = 0.15;

// Of an object that is hardly seen the right pose is no denser than wrong ones beside it. So modes
// are proposed finely, and what lies near a better one goes when all have been judged.
Separation proposed_separation(float nms_radius) { return {nms_radius / 3, 0.52359878F, 6}; }
Separation judged_separation(float nms_radius) { return {nms_radius, 1.0471976F, 3}; }

using Candidates = std::vector<Candidate>;

void sort_by_rank(Candidates::iterator begin, Candidates::iterator end) {
  std::stable_sort(begin, end,
                   [](const Candidate& a, const Candidate& b) { return a.rank > b.rank; });
}

}  // namespace

ObjectSearch::ObjectSearch(const Model& model, Proposals proposals, const InstanceParams& params,
                           const ScanState& scan)
    : model_(model), proposals_(std::move(proposals)), params_(params), scan_(scan) {}

void ObjectSearch::propose() {
  most_support_ = 1e-9;
  pool_.clear();
  std::vector<PoseMode> modes = proposals_.propose();
  std::erase_if(modes, [this](const PoseMode& mode) { return !is_clear(mode.center); });
  for (const std::size_t i :
       separate_modes(modes, proposed_separation(params_.nms_radius), params_.candidates)) {
    set_mode(pool_.emplace_back(), modes[i]);
    most_support_ = std::max(most_support_, modes[i].support);
  }
  if (pool_.size() > kShortlist) {
    judge(0, pool_.size(), kGlance);
    pool_.resize(kShortlist);
  }
  graph::parallel_for(pool_.size(), 1, [this](std::size_t i) {
    set_mode(pool_[i], proposals_.improve(pool_[i].mode));
  });
  judge(0, pool_.size(), kSketch);
  leave_out_likes();
  bring_closer();
  proposed_at_ = scan_.takes;
  choose();
}

/// Of a pool that is sorted. What stays speaks for its place: it takes over the highest support.
void ObjectSearch::leave_out_likes() {
  const Separation separation = judged_separation(params_.nms_radius);
  std::vector<PoseMode> modes;
  for (const Candidate& candidate : pool_) modes.push_back(candidate.mode);
  Candidates kept;
  for (const std::size_t i : separate_modes(modes, separation, modes.size())) {
    Candidate& candidate = kept.emplace_back(std::move(pool_[i]));
    for (const PoseMode& like : modes)
      if (is_like(like, modes[i], separation))
        candidate.mode.support = std::max(candidate.mode.support, like.support);
    set_score(candidate);
  }
  pool_.swap(kept);
  sort_by_rank(pool_.begin(), pool_.end());
}

/// A pose that its votes miss by ten degrees fits no better than a wrong one, until it has taken
/// the first steps. All are kept: the sketch judges where they led.
void ObjectSearch::bring_closer() {
  if (!params_.refine) return;
  const geometry::IcpParams coarse{kCoarseSteps, params_.icp_distance, params_.tolerance,
                                   kCoarseSamples, kCoarseStill};
  const std::size_t count = std::min(kPromising, pool_.size());
  graph::parallel_for(count, 1, [&](std::size_t i) {
    Eigen::Isometry3d& T_scene_model = pool_[i].T_scene_model;
    T_scene_model = geometry::icp(model_.cloud, scan_.surface, T_scene_model, coarse);
  });
  judge(0, count, kSketch);
  sort_by_rank(pool_.begin(), pool_.end());
}

void ObjectSearch::choose() {
  judge_again();
  chosen_at_ = scan_.takes;
  best_ = best_finalist();
  if (best_ && is_convincing(*best_)) {
    polish(*best_);
    if (is_convincing(*best_) && is_clear(center_of(*best_))) return;
  }
  best_.reset();
  pool_.clear();
}

/// By its fit and its consensus, which this sets.
bool ObjectSearch::is_convincing(Candidate& candidate) const {
  if (proposals_.votes_per_correspondence > 0) candidate.consensus = consensus(candidate);
  return candidate.confidence() > 0 && candidate.confidence() >= params_.min_score;
}

void ObjectSearch::accept() {
  taken_.push_back(best_->mode.center);
  taken_.push_back(center_of(*best_));
  ++accepted_;
  best_.reset();
  std::erase_if(
      pool_, [this](const Candidate& other) { return is_full() || !is_clear(other.mode.center); });
}

/// Scores part of the pool by some model points and sorts all up to its end.
void ObjectSearch::judge(std::size_t begin, std::size_t end, Eigen::Index samples) {
  graph::parallel_for(end - begin, 1, [&](std::size_t i) {
    Candidate& candidate = pool_[begin + i];
    candidate.fit = measure(candidate.T_scene_model, samples);
    set_score(candidate);
  });
  sort_by_rank(pool_.begin(), pool_.begin() + static_cast<std::ptrdiff_t>(end));
}

/// Brings the finalists to the front. Scores of before something was taken out, and of sketches,
/// are taken as upper bounds.
void ObjectSearch::judge_again() {
  constexpr std::size_t kBatch = 2 * kFinalists;
  for (std::size_t done = 0; done < pool_.size();) {
    const std::size_t end = std::min(done + kBatch, pool_.size());
    judge(done, end, kLook);
    done = end;
    if (done < pool_.size() && pool_[kFinalists - 1].rank >= pool_[done].rank) break;
  }
  std::erase_if(pool_, [](const Candidate& candidate) { return candidate.score == 0; });
}

/// Refines the first of a sorted list, as many as may turn out the best. Returns their end.
Candidates::iterator ObjectSearch::refine_best(Candidates& sorted) const {
  const std::size_t most = std::min(kFinalists, sorted.size());
  std::size_t count = 0;
  while (count < most && sorted[count].rank >= kHopeless * sorted[0].rank &&
         sorted[count].score >= kHopeless * params_.min_score)
    ++count;
  graph::parallel_for(count, 1, [&](std::size_t i) { refine(sorted[i]); });
  return sorted.begin() + static_cast<std::ptrdiff_t>(count);
}

/// The best of the finalists after ICP that reaches the threshold by its fit, itself or the twin
/// that is better than it. Those that ICP carries onto an instance that is found already leave the
/// pool.
std::optional<Candidate> ObjectSearch::best_finalist() {
  while (!pool_.empty()) {
    const Candidates::iterator end = refine_best(pool_);
    if (end == pool_.begin()) break;
    sort_by_rank(pool_.begin(), end);
    const Candidate* first = nullptr;
    for (auto candidate = pool_.begin(); candidate != end; ++candidate) {
      if (!is_clear(center_of(*candidate))) continue;
      if (candidate->score < params_.min_score) {
        if (!first) first = &*candidate;
        continue;
      }
      const Candidate best = best_alike(*candidate);
      if (best.score >= params_.min_score) return best;
    }
    if (first) return best_alike(*first);  // a twin may reach it
    pool_.erase(pool_.begin(), end);
  }
  return std::nullopt;
}

/// The best of a pose and those that look nearly like it. They share the mode that proposed it.
/// Where they differ decides; where that says nothing, their ranks.
Candidate ObjectSearch::best_alike(const Candidate& candidate) const {
  const std::vector<NearSymmetry>& near = model_.near_symmetries.items;
  Candidates alike(near.size(), candidate);
  graph::parallel_for(alike.size(), 1, [&](std::size_t i) {
    alike[i].is_refined = false;
    alike[i].near_symmetry = i;
    alike[i].T_scene_model = candidate.T_scene_model * near[i].motion;
    alike[i].fit = measure(alike[i].T_scene_model, kLook);
    set_score(alike[i]);
  });
  sort_by_rank(alike.begin(), alike.end());
  alike.erase(refine_best(alike), alike.end());
  Candidate best = candidate;
  using Standing = std::pair<double, double>;  // what tells, then the rank
  Standing highest{0, candidate.rank};
  for (const Candidate& other : alike) {
    const double lead = lead_over(candidate, other);
    if (lead < -kTelling) continue;
    const Standing standing = lead > kTelling ? Standing{lead, 0} : Standing{0, other.rank};
    if (standing <= highest || !is_clear(center_of(other))) continue;
    best = other;
    highest = standing;
  }
  return best;
}

/// How much more the scan speaks for a pose than for the one that a near symmetry made it of, where
/// they differ, in standard deviations.
double ObjectSearch::lead_over(const Candidate& origin, const Candidate& other) const {
  const auto weigh = [&](const std::vector<std::uint32_t>& points, const Candidate& candidate) {
    return weigh_points(model_.cloud, points, scan_.surface, scan_.view, candidate.T_scene_model,
                        params_.tolerance);
  };
  const NearSymmetry& symmetry = model_.near_symmetries.items[other.near_symmetry];
  const Evidence for_other = weigh(symmetry.carried_off, other);
  const Evidence for_origin = weigh(symmetry.uncovered, origin);
  const auto sides = static_cast<double>(for_other.sides + for_origin.sides);
  return sides > 0 ? (for_other.balance - for_origin.balance) / std::sqrt(sides) : 0;
}

/// ICP on a pose that was looked at, near enough to choose. Done once for a mode: what is taken out
/// of the scan later moves no pose.
void ObjectSearch::refine(Candidate& candidate) const {
  if (!candidate.is_refined)
    run_icp(candidate, {params_.icp_iterations, params_.icp_distance, params_.tolerance,
                        kIcpSamples, kIcpStill});
  candidate.fit = measure(candidate.T_scene_model, kClose);
  candidate.is_refined = true;
  set_score(candidate);
}

/// As exact as the scan allows, for the pose that is chosen.
void ObjectSearch::polish(Candidate& candidate) const {
  run_icp(candidate,
          {params_.icp_iterations, params_.tolerance, params_.tolerance, kPolishSamples});
  candidate.fit = measure(candidate.T_scene_model, 0);
  set_score(candidate);
}

/// Kept where it keeps the support.
void ObjectSearch::run_icp(Candidate& candidate, const geometry::IcpParams& params) const {
  if (!params_.refine) return;
  const auto support = [this](const Eigen::Isometry3d& T_scene_model) {
    return static_cast<double>(measure(T_scene_model, kLook).supported);
  };
  const Eigen::Isometry3d T_refined =
      geometry::icp(model_.cloud, scan_.surface, candidate.T_scene_model, params);
  if (support(T_refined) >= kKeptSupport * support(candidate.T_scene_model))
    candidate.T_scene_model = T_refined;
}

void ObjectSearch::set_mode(Candidate& candidate, const PoseMode& mode) const {
  candidate.mode = mode;
  candidate.T_scene_model = T_scene_model_of(mode, model_.center);
}

void ObjectSearch::set_score(Candidate& candidate) const {
  candidate.score = fit_score(candidate.fit);
  if (candidate.is_refined) candidate.score *= exactness(candidate);
  candidate.rank =
      candidate.score * std::pow(candidate.mode.support / most_support_, kTrustInSupport);
}

/// In [0.6, 1], by the instances of all objects that were found before.
double ObjectSearch::exactness(const Candidate& candidate) const {
  if (!params_.refine || params_.max_residual == 0) return 1;  // rough poses leave more than noise
  return scan_.usual_residual.exactness(
      candidate.fit, scan_.range_of(model_, candidate.T_scene_model), params_.max_residual,
      kSampled * static_cast<double>(params_.tolerance));
}

/// In [0, 1], from the support per feature of the scan that the pose explains.
double ObjectSearch::consensus(const Candidate& candidate) const {
  const std::size_t explained =
      scan_.count_explained(model_, candidate.T_scene_model, params_.tolerance);
  const double votes = static_cast<double>(std::max<std::size_t>(1, explained)) *
                       proposals_.votes_per_correspondence / kUsualVotes;
  const double share = candidate.mode.support / votes;
  return std::pow(std::min(1.0, share), kTrustInConsensus);
}

Fit ObjectSearch::measure(const Eigen::Isometry3d& T_scene_model, Eigen::Index samples) const {
  return measure_fit(model_.cloud, model_.outline, scan_.surface, scan_.view, T_scene_model,
                     params_.tolerance, samples);
}

Eigen::Vector3f ObjectSearch::center_of(const Candidate& candidate) const {
  return posed_center(candidate.T_scene_model, model_.center).cast<float>();
}

bool ObjectSearch::is_clear(const Eigen::Vector3f& center) const {
  return std::all_of(taken_.begin(), taken_.end(), [&](const Eigen::Vector3f& other) {
    return (center - other).norm() > params_.nms_radius;
  });
}

}  // namespace posevote::segment
