// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/pool.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "nodes/poses/peek.hpp"
#include "nodes/poses/score.hpp"
#include "nodes/poses/separation.hpp"

namespace posevote::poses {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Separation proposed_separation(const Sought& sought) {
  const PoolTerms& terms = sought.terms.pool;
  return {sought.params.nms_radius / static_cast<float>(terms.proposed_fineness),
          static_cast<float>(terms.proposed_angle * kDegree), terms.proposed_per_place};
}

Separation judged_separation(const Sought& sought) {
  const PoolTerms& terms = sought.terms.pool;
  return {sought.params.nms_radius, static_cast<float>(terms.judged_angle * kDegree),
          terms.judged_per_place};
}

}  // namespace

double support_elsewhere(const std::vector<Hypothesis>& proposals, const Eigen::Vector3f& center,
                         const Model& model) {
  const float radius = kRunnerUpRadius * model.diagonal;
  const auto other = std::find_if(proposals.begin(), proposals.end(), [&](const Hypothesis& one) {
    return (one.center - center).norm() > radius;
  });
  return other == proposals.end() ? 0 : other->support;
}

void TakenPlaces::take(const Model& model, const Candidate& instance) {
  centers_.push_back(instance.proposed.center);
  centers_.push_back(posed_center(instance.T_scene_model, model.center).cast<float>());
}

bool TakenPlaces::is_clear(const Eigen::Vector3f& center) const {
  return std::all_of(centers_.begin(), centers_.end(), [&](const Eigen::Vector3f& other) {
    return (center - other).norm() > radius_;
  });
}

void TakenPlaces::leave_clear(std::vector<Hypothesis>& proposals) const {
  std::erase_if(proposals, [this](const Hypothesis& one) { return !is_clear(one.center); });
}

bool TakenPlaces::is_clear(const Sought& sought, const Eigen::Isometry3d& T_scene_model) const {
  return is_clear(
             Eigen::Vector3f(posed_center(T_scene_model, sought.model.center).cast<float>())) &&
         sought.scan.share_inside(sought.model, T_scene_model) <= sought.params.overlap;
}

Candidates collect(Sought& sought, std::vector<Hypothesis> proposals, const TakenPlaces& taken) {
  taken.leave_clear(proposals);
  const std::vector<std::size_t> separate =
      separate_poses(proposals, proposed_separation(sought), sought.params.candidates);
  sought.most_support =
      separate.empty() ? kSomeSupport : std::max(kSomeSupport, proposals[separate[0]].support);
  const auto candidates_of = [&](const std::vector<std::size_t>& some) {
    Candidates pool;
    for (const std::size_t i : some) {
      Candidate& candidate = pool.emplace_back();
      propose_as(sought, proposals[i], candidate);
      candidate.elsewhere = support_elsewhere(proposals, proposals[i].center, sought.model);
    }
    return pool;
  };
  if (sought.watch) sought.watch("propose", candidates_of(separate));
  return candidates_of(worth_a_glance(sought, proposals, separate));
}

void propose_as(const Sought& sought, const Hypothesis& hypothesis, Candidate& candidate) {
  candidate.proposed = hypothesis;
  candidate.T_scene_model = T_scene_model_of(hypothesis, sought.model.center);
}

void leave_out_likes(const Sought& sought, Candidates& pool) {
  const Separation separation = judged_separation(sought);
  std::vector<Hypothesis> proposed;
  for (const Candidate& candidate : pool) proposed.push_back(candidate.proposed);
  Candidates kept;
  for (const std::size_t i : separate_poses(proposed, separation, proposed.size())) {
    Candidate& candidate = kept.emplace_back(std::move(pool[i]));
    for (const Hypothesis& like : proposed)
      if (is_like(like, proposed[i], separation))
        candidate.proposed.support = std::max(candidate.proposed.support, like.support);
    grade(sought, candidate);
  }
  pool.swap(kept);
  sort_by_rank(pool.begin(), pool.end());
}

}  // namespace posevote::poses
