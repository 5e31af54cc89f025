// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/twins.hpp"

#include <algorithm>
#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/poses/confidence.hpp"
#include "nodes/poses/schedule.hpp"
#include "nodes/poses/score.hpp"

namespace posevote::poses {
namespace {

Candidates make_twins(const Sought& sought, const Candidate& candidate) {
  const std::vector<NearSymmetry>& near = sought.model.near_symmetries.items;
  Candidates twins(near.size(), candidate);
  graph::parallel_for(twins.size(), 1, [&](std::size_t i) {
    twins[i].is_refined = false;
    twins[i].near_symmetry = i;
    twins[i].T_scene_model = candidate.T_scene_model * near[i].motion;
    judge(sought, twins[i], {{sought.terms.schedule.look_points}});
  });
  sort_by_rank(twins.begin(), twins.end());
  return twins;
}

/// By what both were judged by, and where they differ. What points say counts up to the lead that
/// tells: they err alike, so more of it is no surer.
double log_odds_over(const Sought& sought, const Candidate& origin, const Candidate& twin,
                     double lead) {
  const TwinTerms& terms = sought.terms.twins;
  return log_odds_of(twin.confidence) - log_odds_of(origin.confidence) +
         terms.lead_odds * std::clamp(lead, -terms.telling, terms.telling);
}

}  // namespace

Candidate best_alike(const Sought& sought, const Candidate& candidate, const TakenPlaces& taken) {
  Candidates twins = make_twins(sought, candidate);
  twins.erase(refine_best(sought, twins), twins.end());
  Candidate best = candidate;
  double highest = 0;
  for (const Candidate& twin : twins) {
    const double by_color = color_lead(twin.colors, candidate.colors);
    const double by_shape = lead_over(sought, candidate, twin);
    // Beside colours, whose places are apart, points that err alike must not count each; and what
    // colours tell leaves no need to ask the confidences.
    const double lead = by_color == 0
                            ? log_odds_over(sought, candidate, twin, by_shape)
                            : by_color + by_shape / std::sqrt(sought.terms.color.err_alike);
    if (lead <= highest || !taken.is_clear(sought, twin.T_scene_model)) continue;
    best = twin;
    highest = lead;
  }
  return best;
}

bool is_better_by_color(const Sought& sought, const Candidate& rival, const Candidate& best) {
  const auto center = [&](const Candidate& candidate) {
    return posed_center(candidate.T_scene_model, sought.model.center);
  };
  return color_lead(rival.colors, best.colors) > sought.terms.twins.telling &&
         rival.confidence > best.confidence &&
         (center(rival) - center(best)).norm() < sought.params.nms_radius;
}

double lead_over(const Sought& sought, const Candidate& origin, const Candidate& twin) {
  const auto weigh = [&](const std::vector<std::uint32_t>& points, const Candidate& candidate) {
    return weigh_points(sought.model.cloud, points, sought.scan.surface, sought.scan.view,
                        candidate.T_scene_model, sought.params.tolerance, sought.terms.fit);
  };
  const NearSymmetry& symmetry = sought.model.near_symmetries.items[twin.near_symmetry];
  const Evidence for_twin = weigh(symmetry.carried_off, twin);
  const Evidence for_origin = weigh(symmetry.uncovered, origin);
  const auto sides = static_cast<double>(for_twin.sides + for_origin.sides);
  return sides > 0 ? (for_twin.balance - for_origin.balance) / std::sqrt(sides) : 0;
}

}  // namespace posevote::poses
