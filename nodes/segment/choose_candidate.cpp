// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/choose_candidate.hpp"

#include <algorithm>

#include "graph/parallel.hpp"
#include "nodes/segment/find_modes.hpp"
#include "nodes/segment/icp.hpp"

namespace posevote {
namespace {

constexpr double kBeyondDoubt = 0.6;    // score at which no other mode is looked at
constexpr std::size_t kFinalists = 5;   // refined by ICP
constexpr Eigen::Index kGlance = 1000;  // model points that judge a mode before ICP
constexpr double kKeptSupport = 0.95;   // ICP may lose a few chance partners at the silhouette

/// Works on the first candidate and, unless it then fits beyond doubt, on all others; the best
/// first.
template <class Work>
void work_on(std::vector<Candidate>& candidates, const Work& work) {
  if (candidates.empty()) return;
  work(candidates.front());
  if (candidates.front().score >= kBeyondDoubt) return candidates.resize(1);
  graph::parallel_for(candidates.size() - 1, 1, [&](std::size_t i) { work(candidates[i + 1]); });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
}

void judge_at_a_glance(Candidate& candidate, const LiveVotes& object, const ScanState& scan,
                       float tolerance) {
  const Model& model = *object.votes->model;
  candidate.mode = refine_mode(*object.votes, *object.raw, object.alive, candidate.mode);
  candidate.T_scene_model = T_scene_model_of(candidate.mode, model.center);
  candidate.fit = measure_fit(model.cloud, scan.surface, scan.view, candidate.T_scene_model,
                              tolerance, kGlance);
  candidate.score = fit_score(candidate.fit);
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
  std::vector<Candidate> candidates;
  for (const PoseMode& mode :
       separate_modes(*object.votes, best_votes(*object.votes, object.density, params.min_density),
                      taken, params.nms_radius, static_cast<std::size_t>(params.candidates)))
    candidates.emplace_back().mode = mode;
  work_on(candidates, [&](Candidate& candidate) {
    judge_at_a_glance(candidate, object, scan, params.tolerance);
  });
  candidates.resize(std::min(candidates.size(), kFinalists));
  work_on(candidates,
          [&](Candidate& candidate) { refine_candidate(candidate, model.cloud, scan, params); });
  for (const Candidate& candidate : candidates)
    if (keeps_clear(candidate, model.center, taken, params.nms_radius)) return candidate;
  return std::nullopt;
}

}  // namespace posevote
