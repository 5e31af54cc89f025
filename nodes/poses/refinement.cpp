// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/refinement.hpp"

#include <algorithm>
#include <vector>

#include "nodes/geometry/edge_pairs.hpp"
#include "nodes/poses/color_turns.hpp"
#include "nodes/poses/confidence.hpp"
#include "nodes/poses/score.hpp"

namespace posevote::poses {
namespace {

enum Kind { kFirstSteps, kFull, kPolish };

void run_icp(const Sought& sought, Candidate& candidate, Kind kind,
             const geometry::IcpParams& params, const geometry::MorePairs& more = {}) {
  if (!sought.params.refine) return;
  const Eigen::Isometry3d start = candidate.T_scene_model;
  candidate.T_scene_model = sought.memory->refined.get(sought.scan, {start, kind}, [&] {
    Answer<Eigen::Isometry3d> end{start, {}, 0};
    const auto pass = [&](const Eigen::Isometry3d& T_scene_model) {
      end.centers.extend(posed_center(T_scene_model, sought.model.center));
    };
    pass(start);
    end.value = geometry::icp(sought.model.cloud, sought.scan.surface, start, params, pass, more);
    end.radius = sought.reach +
                 1.001 * static_cast<double>(std::max(params.start_distance, params.end_distance));
    return end;
  });
}

/// Found once, and only where ICP has to run.
const std::vector<geometry::FaceEnd>& face_ends(const Sought& sought) {
  auto& known = sought.memory->face_ends;
  if (!known)
    known = geometry::find_face_ends(sought.model.cloud, sought.model.outline,
                                     sought.scan.resolution, sought.terms.edges.ends);
  return *known;
}

}  // namespace

void take_first_steps(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  run_icp(sought, candidate, kFirstSteps,
          {terms.coarse_steps, sought.params.icp_distance, sought.params.tolerance,
           terms.coarse_points, terms.full_still, sought.terms.icp});
}

void refine(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  if (!candidate.is_refined)
    run_icp(sought, candidate, kFull,
            {sought.params.icp_iterations, sought.params.icp_distance, sought.params.tolerance,
             terms.full_points, terms.full_still, sought.terms.icp});
  candidate.is_refined = true;
  turn_by_color(sought, candidate);
  judge(sought, candidate, {{sought.terms.schedule.close_points, true}});
  believe(sought, candidate);
}

void polish(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  run_icp(sought, candidate, kPolish,
          {sought.params.icp_iterations, sought.params.tolerance, sought.params.tolerance,
           terms.polish_points, terms.polish_still, sought.terms.icp},
          [&](const auto& pose, double variance) {
            return geometry::FaceEnds(sought.model.cloud, face_ends(sought), sought.scan.surface,
                                      sought.scan.view, sought.scan.resolution, sought.terms.edges)
                .pairs(pose, variance);
          });
  turn_by_color(sought, candidate);
  judge(sought, candidate, kAllPoints);
  believe(sought, candidate);
}

}  // namespace posevote::poses
