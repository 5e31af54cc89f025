// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "nodes/geometry/contour_pairs.hpp"
#include "nodes/geometry/edge_pairs.hpp"
#include "nodes/poses/color_turns.hpp"
#include "nodes/poses/confidence.hpp"

namespace posevote::poses {
namespace {

/// Steps of refinement, and the same with contours.
enum Kind { kFirstSteps, kFull, kPolish, kFullByContour, kPolishByContour };

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
    const auto partners = static_cast<double>(std::max(params.start_distance, params.end_distance));
    const double ends =
        more ? sought.terms.edges.reach * static_cast<double>(sought.scan.resolution) : 0;
    end.radius = sought.reach + 1.001 * std::max(partners, ends);
    return end;
  });
}

/// For each of ICP's `points` on planes as many ends as in the last ICP.
geometry::MorePairs ends_of(const Sought& sought, int points) {
  const double share =
      std::min(1.0, static_cast<double>(points) / sought.terms.refinement.polish_points);
  const auto most = static_cast<int>(std::ceil(share * sought.terms.edges.ends));
  return [&sought, most](const Eigen::Isometry3d& pose, double variance) {
    const Model& model = sought.model;
    const float resolution = sought.scan.resolution;
    const std::vector<FaceEnd>& ends = model.face_ends.get(resolution, most, [&] {
      return geometry::find_face_ends(model.cloud, *sought.model_index, model.outline, resolution,
                                      most);
    });
    return geometry::FaceEnds(model.cloud, ends, sought.scan.surface, sought.scan.view, resolution,
                              sought.terms.edges)
        .pairs(pose, variance);
  };
}

geometry::MorePairs contour_of(const Sought& sought) {
  return [&sought](const Eigen::Isometry3d& pose, double variance) {
    return geometry::contour_pairs(sought.model.cloud, sought.scan.surface, sought.scan.view, pose,
                                   sought.scan.resolution, variance, sought.terms.contour);
  };
}

geometry::MorePairs both(geometry::MorePairs one, geometry::MorePairs other) {
  return [one = std::move(one), other = std::move(other)](const auto& pose, double variance) {
    std::vector<geometry::IcpPair> pairs = one(pose, variance);
    std::ranges::copy(other(pose, variance), std::back_inserter(pairs));
    return pairs;
  };
}

/// A long slide along a surface is for the pose that is chosen.
geometry::IcpParams steps_from(const Sought& sought, float distance, int points, double still,
                               bool follows_drift) {
  return {sought.params.icp_iterations,
          distance,
          sought.params.tolerance,
          points,
          still,
          follows_drift,
          sought.terms.icp};
}

/// A confidence that neither a contour nor exactness makes a detection's.
constexpr double kHopeless = 0.03;

void judge_refined(const Sought& sought, Candidate& candidate, const Closeness& look) {
  turn_by_color(sought, candidate);
  judge_closely(sought, candidate, look);
}

/// Whether free space speaks against a pose that may be right nevertheless, and is not sure yet.
bool may_gain_by_contour(const Sought& sought, const Candidate& candidate) {
  constexpr double kFew = 0.02;  // of the points that take a side, seen through
  constexpr double kSure = 0.9;  // a confidence that a contour hardly changes
  if (!sought.params.refine || sought.terms.contour.points == 0) return false;
  if (candidate.confidence <= kHopeless || candidate.confidence >= kSure) return false;
  const auto sides = static_cast<double>(candidate.fit.facing - candidate.fit.hidden);
  return static_cast<double>(candidate.fit.contradicted) > kFew * sides;
}

/// Kept where it makes the pose more probable: beside what touches the object, or is in its place,
/// contours mislead.
void try_contour(const Sought& sought, Candidate& candidate, Kind kind,
                 const geometry::IcpParams& params, const geometry::MorePairs& more,
                 const Closeness& look) {
  if (!may_gain_by_contour(sought, candidate)) return;
  Candidate moved = candidate;
  run_icp(sought, moved, kind, params, more);
  judge_refined(sought, moved, look);
  if (moved.confidence > candidate.confidence) candidate = std::move(moved);
}

}  // namespace

/// Exactness only takes from a confidence, and is asked for last, since it takes longer than the fit.
void judge_closely(const Sought& sought, Candidate& candidate, const Closeness& look) {
  judge(sought, candidate, look);
  believe(sought, candidate);
  if (candidate.confidence <= kHopeless) return;
  measure_residual(sought, candidate, look.sampling.points);
  if (exactness(sought, candidate) == 1) return;
  grade(sought, candidate);
  believe(sought, candidate);
}

void take_first_steps(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  geometry::IcpParams steps =
      steps_from(sought, sought.params.icp_distance, terms.coarse_points, terms.full_still, false);
  steps.iterations = terms.coarse_steps;
  run_icp(sought, candidate, kFirstSteps, steps);
}

void refine(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  const Closeness look{{sought.terms.schedule.close_points, true}};
  const auto steps = [&](float distance) {
    return steps_from(sought, distance, terms.full_points, terms.full_still, false);
  };
  const bool is_new = !std::exchange(candidate.is_refined, true);
  if (is_new)
    run_icp(sought, candidate, kFull, steps(sought.params.icp_distance),
            ends_of(sought, terms.full_points));
  judge_refined(sought, candidate, look);
  if (!is_new) return;
  try_contour(sought, candidate, kFullByContour, steps(sought.params.tolerance), contour_of(sought),
              look);
}

void polish(const Sought& sought, Candidate& candidate) {
  const RefinementTerms& terms = sought.terms.refinement;
  const geometry::IcpParams steps =
      steps_from(sought, sought.params.tolerance, terms.polish_points, terms.polish_still, true);
  const geometry::MorePairs ends = ends_of(sought, terms.polish_points);
  run_icp(sought, candidate, kPolish, steps, ends);
  judge_refined(sought, candidate, kAllPoints);
  try_contour(sought, candidate, kPolishByContour, steps, both(ends, contour_of(sought)),
              kAllPoints);
}

}  // namespace posevote::poses
