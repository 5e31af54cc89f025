// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/score.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/poses/confidence.hpp"
#include "nodes/poses/systematic_residual.hpp"

namespace posevote::poses {

namespace {

/// What depends on the scan within the tolerance of a posed model.
template <class Value>
Answer<Value> answer_at(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                        double tolerance, Value value) {
  const Eigen::Vector3d center = posed_center(T_scene_model, sought.model.center);
  return {std::move(value), Eigen::AlignedBox3d(center), sought.reach + 1.001 * tolerance};
}

std::size_t count_explained(const Sought& sought, const Eigen::Isometry3d& T_scene_model) {
  return sought.memory->explained.get(sought.scan, {T_scene_model}, [&] {
    return answer_at(sought, T_scene_model, static_cast<double>(sought.params.tolerance),
                     sought.scan.count_explained(sought.model, *sought.model_index, T_scene_model,
                                                 sought.params.tolerance, sought.voters));
  });
}

}  // namespace

Fit measure(const Sought& sought, const Eigen::Isometry3d& T_scene_model, const Closeness& look) {
  const double tolerance = look.reach * static_cast<double>(sought.params.tolerance);
  return sought.memory->fits.get(
      sought.scan, {T_scene_model, 2 * look.sampling.points + look.sampling.closely, look.reach},
      [&] {
        return answer_at(sought, T_scene_model, tolerance,
                         measure_fit(sought.model.cloud, sought.model.outline, sought.scan.surface,
                                     sought.scan.view, T_scene_model, static_cast<float>(tolerance),
                                     look.sampling, sought.terms.fit));
      });
}

void measure_residual(const Sought& sought, Candidate& candidate, Eigen::Index points) {
  const Eigen::Isometry3d& T_scene_model = candidate.T_scene_model;
  const Shared left = sought.memory->residuals.get(sought.scan, {T_scene_model, points}, [&] {
    return answer_at(sought, T_scene_model, static_cast<double>(kFarOff * sought.params.tolerance),
                     systematic_residual(sought, T_scene_model, points));
  });
  candidate.fit.systematic = left.deviation;
  candidate.fit.systematic_doubt = left.doubt;
}

void grade_at_a_glance(const Sought& sought, Candidate& candidate) {
  candidate.quality = fit_quality(candidate.fit, sought.terms.fit);
  if (candidate.is_refined)
    candidate.quality *= std::max(sought.terms.score.least_exactness, exactness(sought, candidate));
  candidate.rank = candidate.quality * std::pow(candidate.proposed.support / sought.most_support,
                                                sought.terms.score.trust_in_support);
}

void grade(const Sought& sought, Candidate& candidate) {
  grade_at_a_glance(sought, candidate);
  candidate.rank *=
      std::exp(sought.terms.score.trust_in_clues * first_log_odds(candidate, sought.terms));
}

void judge(const Sought& sought, Candidate& candidate, const Closeness& look) {
  candidate.fit = measure(sought, candidate.T_scene_model, look);
  grade(sought, candidate);
}

bool is_convincing(const Sought& sought, const Candidate& candidate) {
  return candidate.score() > 0 && candidate.score() >= sought.params.min_score &&
         candidate.confidence >= sought.terms.confidence.doubtful * sought.params.min_confidence;
}

double exactness(const Sought& sought, const Candidate& candidate) {
  const InstanceParams& params = sought.params;
  if (!params.refine || params.max_residual == 0) return 1;  // rough poses leave more than noise
  return sought.scan.usual_residual.exactness(
      candidate.fit, sought.scan.range_of(sought.model, candidate.T_scene_model),
      {params.max_residual,
       sought.terms.score.sampled_residual * static_cast<double>(params.tolerance)});
}

/// The fit tells how much of the surface is there, the consensus how many of the features on it had
/// voted for the pose before anybody looked.
double votes_per_feature(const Sought& sought, const Candidate& candidate) {
  const std::size_t explained = count_explained(sought, candidate.T_scene_model);
  const double votes = static_cast<double>(std::max<std::size_t>(1, explained)) *
                       sought.votes_per_correspondence / sought.terms.score.usual_votes;
  return candidate.proposed.support / votes;
}

double consensus(double votes_per_feature, const ScoreTerms& terms) {
  return std::pow(std::min(1.0, votes_per_feature), terms.trust_in_consensus);
}

}  // namespace posevote::poses
