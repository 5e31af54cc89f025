// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/choose_candidate.hpp"

#include <algorithm>

#include "nodes/segment/find_modes.hpp"
#include "nodes/segment/icp.hpp"

namespace posevote {
namespace {

constexpr double kBeyondDoubt = 0.8;        // score at which no further mode is looked at
constexpr std::size_t kFinalists = 5;       // refined by ICP
constexpr Eigen::Index kGlance = 2000;      // model points that judge a mode before ICP
constexpr double kKeptSupport = 0.95;       // ICP may lose a few chance partners at the silhouette

Candidate judge_mode(const LiveVotes& object, const ScanState& scan, std::uint32_t vote,
                     float tolerance) {
  const Model& model = *object.votes->model;
  Candidate candidate;
  candidate.mode =
      refine_mode(*object.votes, *object.raw, object.alive, vote_pose(*object.votes, vote));
  candidate.T_scene_model = T_scene_model_of(candidate.mode, model.center);
  candidate.fit = measure_fit(model.cloud, scan.surface, scan.view, candidate.T_scene_model,
                              tolerance, kGlance);
  candidate.score = fit_score(candidate.fit);
  return candidate;
}

/// The densest modes as they stand, best first.
std::vector<Candidate> judge_modes(const LiveVotes& object, const ScanState& scan,
                                   std::vector<Eigen::Vector3f> taken,
                                   const CandidateParams& params) {
  const std::vector<std::uint32_t> votes = best_votes(*object.votes, object.density);
  std::vector<Candidate> candidates;
  for (int i = 0; i < params.candidates; ++i) {
    const auto vote = next_mode(*object.votes, votes, taken, params.nms_radius);
    if (!vote || object.density[*vote] < params.min_density) break;
    candidates.push_back(judge_mode(object, scan, *vote, params.tolerance));
    taken.push_back(vote_center(*object.votes, *vote));
    if (candidates.back().score >= kBeyondDoubt) break;
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return candidates;
}

/// ICP, kept where it keeps the support that the mode had.
void refine_candidate(Candidate& candidate, const Cloud& model, const ScanState& scan,
                      const CandidateParams& params) {
  const auto measure = [&](const Eigen::Isometry3d& T_scene_model) {
    return measure_fit(model, scan.surface, scan.view, T_scene_model, params.tolerance);
  };
  candidate.fit = measure(candidate.T_scene_model);
  if (params.refine) {
    const Eigen::Isometry3d T_refined =
        icp(model, scan.surface, candidate.T_scene_model,
            {params.icp_iterations, params.icp_distance, params.tolerance});
    const Fit refined = measure(T_refined);
    const double fewest = kKeptSupport * static_cast<double>(candidate.fit.supported);
    if (static_cast<double>(refined.supported) >= fewest) {
      candidate.T_scene_model = T_refined;
      candidate.fit = refined;
    }
  }
  candidate.score = fit_score(candidate.fit);
}

/// ICP can carry a candidate onto an instance that was found before.
bool keeps_clear(const Candidate& candidate, const Eigen::Vector3f& model_center,
                 const std::vector<Eigen::Vector3f>& taken, float radius) {
  const Eigen::Vector3f center =
      (candidate.T_scene_model * model_center.cast<double>()).cast<float>();
  return std::all_of(taken.begin(), taken.end(), [&](const Eigen::Vector3f& other) {
    return (center - other).norm() > radius;
  });
}

}  // namespace

std::optional<Candidate> choose_candidate(const LiveVotes& object, const ScanState& scan,
                                          const std::vector<Eigen::Vector3f>& taken,
                                          const CandidateParams& params) {
  const Model& model = *object.votes->model;
  std::vector<Candidate> candidates = judge_modes(object, scan, taken, params);
  candidates.resize(std::min(candidates.size(), kFinalists));
  std::optional<Candidate> best;
  for (Candidate& candidate : candidates) {
    refine_candidate(candidate, model.cloud, scan, params);
    if (!keeps_clear(candidate, model.center, taken, params.nms_radius)) continue;
    if (!best || candidate.score > best->score) best = candidate;
    if (best->score >= kBeyondDoubt) break;
  }
  return best;
}

}  // namespace posevote
