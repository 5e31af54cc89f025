// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/refinement.hpp"

#include "nodes/poses/confidence.hpp"
#include "nodes/poses/score.hpp"

namespace posevote::poses {
namespace {

void run_icp(const Sought& sought, Candidate& candidate, const geometry::IcpParams& params) {
  if (!sought.params.refine) return;
  candidate.T_scene_model =
      geometry::icp(sought.model.cloud, sought.scan.surface, candidate.T_scene_model, params);
}

}  // namespace

void take_first_steps(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  run_icp(sought, candidate,
          {terms.coarse_steps, sought.params.icp_distance, sought.params.tolerance,
           terms.coarse_points, terms.full_still, sought.terms.icp});
}

void refine(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  if (!candidate.is_refined)
    run_icp(sought, candidate,
            {sought.params.icp_iterations, sought.params.icp_distance, sought.params.tolerance,
             terms.full_points, terms.full_still, sought.terms.icp});
  candidate.is_refined = true;
  judge(sought, candidate, sought.terms.schedule.close_points);
  believe(sought, candidate);
}

void polish(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  run_icp(sought, candidate,
          {sought.params.icp_iterations, sought.params.tolerance, sought.params.tolerance,
           terms.polish_points, terms.polish_still, sought.terms.icp});
  judge(sought, candidate, 0);
  believe(sought, candidate);
}

}  // namespace posevote::poses
