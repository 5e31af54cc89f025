// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/refinement.hpp"

#include "nodes/poses/score.hpp"

namespace posevote::poses {
namespace {

Eigen::Isometry3d refined(const Sought& sought, const Candidate& candidate,
                          const geometry::IcpParams& params) {
  return geometry::icp(sought.model.cloud, sought.scan.surface, candidate.T_scene_model, params);
}

/// Kept where it keeps the support.
void refine_if_kept(const Sought& sought, Candidate& candidate, const geometry::IcpParams& params) {
  if (!sought.params.refine) return;
  const auto support = [&](const Eigen::Isometry3d& T_scene_model) {
    return static_cast<double>(
        measure(sought, T_scene_model, sought.terms.schedule.look_points).supported);
  };
  const Eigen::Isometry3d T_refined = refined(sought, candidate, params);
  if (support(T_refined) >= sought.terms.refinement.kept_support * support(candidate.T_scene_model))
    candidate.T_scene_model = T_refined;
}

}  // namespace

void take_first_steps(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  if (!sought.params.refine) return;
  candidate.T_scene_model =
      refined(sought, candidate,
              {terms.coarse_steps, sought.params.icp_distance, sought.params.tolerance,
               terms.coarse_points, terms.coarse_still, sought.terms.icp});
}

void refine(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  if (!candidate.is_refined)
    refine_if_kept(
        sought, candidate,
        {sought.params.icp_iterations, sought.params.icp_distance, sought.params.tolerance,
         terms.full_points, terms.full_still, sought.terms.icp});
  candidate.is_refined = true;
  judge(sought, candidate, sought.terms.schedule.close_points);
}

void polish(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  refine_if_kept(sought, candidate,
                 {sought.params.icp_iterations, sought.params.tolerance, sought.params.tolerance,
                  terms.polish_points, terms.polish_still, sought.terms.icp});
  judge(sought, candidate, 0);
}

}  // namespace posevote::poses
