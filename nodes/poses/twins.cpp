// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/twins.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "graph/parallel.hpp"
#include "nodes/geometry/rotation.hpp"
#include "nodes/poses/confidence.hpp"
#include "nodes/poses/refinement.hpp"
#include "nodes/poses/residual_lead.hpp"
#include "nodes/poses/schedule.hpp"
#include "nodes/poses/score.hpp"

namespace posevote::poses {
namespace {

/// As a near symmetry of the model makes it, not refined.
Candidate twin_of(const Sought& sought, const Candidate& candidate, std::size_t near_symmetry) {
  Candidate twin = candidate;
  twin.is_refined = false;
  twin.near_symmetry = near_symmetry;
  twin.of_twin = 0;
  twin.T_scene_model =
      candidate.T_scene_model * sought.model.near_symmetries.items[near_symmetry].motion;
  return twin;
}

/// A lead, or odds, as far as what tells.
double bounded(double lead, const TwinTerms& terms) {
  return std::clamp(lead, -terms.telling, terms.telling);
}

/// As lead_over, of the scan's points.
double scan_lead_over(const Sought& sought, const Candidate& origin, const Candidate& twin) {
  return residual_lead(sought, twin.T_scene_model, origin.T_scene_model);
}

/// As lead_over, of the ground: a mug's handle that is hidden in both poses does not reach into it.
double ground_lead_over(const Sought& sought, const Candidate& origin, const Candidate& twin) {
  return sought.scan.ground.lead_over(sought.model, twin.T_scene_model, origin.T_scene_model);
}

/// By their rank, but last those that reach into the ground on which the candidate stands. Of more
/// than are refined the first steps of ICP tell which: a handle that is seen beside where a turn would
/// have it speaks against that turn.
Candidates make_twins(const Sought& sought, const Candidate& candidate) {
  Candidates twins(sought.model.near_symmetries.items.size());
  const bool many = std::ssize(twins) > sought.terms.schedule.finalists && sought.params.refine;
  graph::parallel_for(twins.size(), 1, [&](std::size_t i) {
    twins[i] = twin_of(sought, candidate, i);
    if (many) take_first_steps(sought, twins[i]);
    judge(sought, twins[i], {{sought.terms.schedule.look_points}});
  });
  sort_by_rank(twins.begin(), twins.end());
  std::ranges::stable_partition(twins, [&](const Candidate& twin) {
    return ground_lead_over(sought, candidate, twin) > -sought.terms.twins.telling;
  });
  return twins;
}

/// By colours, by what both were judged by, by the ground, and where they differ; none of them but
/// colours counts beyond what tells, for each may err: a twin that reaches into a neighbour lies on
/// its points. The scan's points, which take longest, are asked only where they might bring it above
/// `needed`.
double log_odds_over(const Sought& sought, const Candidate& origin, const Candidate& twin,
                     double needed) {
  const TwinTerms& terms = sought.terms.twins;
  const double judged = log_odds_of(twin.confidence) - log_odds_of(origin.confidence);
  const double odds = color_lead(twin.colors, origin.colors) + bounded(judged, terms) +
                      log_odds_of_lead(lead_over(sought, origin, twin), terms) +
                      log_odds_of_lead(ground_lead_over(sought, origin, twin), terms);
  if (odds + log_odds_of_lead(terms.telling, terms) <= needed) return odds;
  return odds + log_odds_of_lead(scan_lead_over(sought, origin, twin), terms);
}

/// That one of the two is there is as probable as the better judged one said, whichever it is.
void inherit(const Sought& sought, const Candidate& outdone, Candidate& best) {
  const double more = log_odds_of(outdone.confidence) - log_odds_of(best.confidence);
  best.of_twin = std::max(0.0, bounded(more, sought.terms.twins));
  best.confidence = confidence_of(best, sought.terms);
}

constexpr double kSameTurn = 0.35;    // [rad] 20 deg, as in find_symmetries
constexpr double kNegligible = 0.02;  // too improbable to be told

/// Whether a turn is one of the symmetries.
bool is_among(const Eigen::Quaterniond& turn, const Symmetries& symmetries) {
  if (symmetries.axes.size() > 1) return true;
  return std::ranges::any_of(symmetries.turns, [&](const Eigen::Quaternionf& one) {
    const Eigen::Quaterniond between = one.cast<double>().normalized().conjugate() * turn;
    if (symmetries.axes.empty())
      return between.angularDistance(Eigen::Quaterniond::Identity()) < kSameTurn;
    const Eigen::Vector3d axis = symmetries.axes[0].cast<double>();
    return geometry::angle_between_axes(axis, between * axis) < kSameTurn;
  });
}

/// How much more the scan speaks for a twin that was not refined, by shape, and by colours where they
/// are known.
double lead_of_all(const Sought& sought, const Candidate& candidate, Candidate twin) {
  if (candidate.colors)
    twin.colors = measure_colors(sought, twin.T_scene_model, sought.terms.color.look_points);
  const double by_color = color_lead(twin.colors, candidate.colors);
  // Beside colours, whose places are apart, points that err alike must not count each.
  const double count_for_one = by_color != 0 ? sought.terms.color.err_alike : 1;
  return by_color + lead_over(sought, candidate, twin) / std::sqrt(count_for_one) +
         scan_lead_over(sought, candidate, twin) + ground_lead_over(sought, candidate, twin);
}

}  // namespace

std::vector<LookAlike> look_alikes(const Sought& sought, const Candidate& candidate) {
  const std::vector<NearSymmetry>& near = sought.model.near_symmetries.items;
  const Symmetries& known = candidate.symmetries ? *candidate.symmetries : sought.model.symmetries;
  std::vector<LookAlike> others(near.size());
  graph::parallel_for(near.size(), 1, [&](std::size_t i) {
    if (is_among(Eigen::Quaterniond(near[i].motion.linear()), known)) return;
    // What speaks for the other was outweighed when this one was chosen.
    const double lead =
        std::min(lead_of_all(sought, candidate, twin_of(sought, candidate, i)), 0.0);
    others[i] = {near[i].motion, std::exp(sought.terms.twins.lead_odds * lead)};
  });
  double sum = 1;
  for (const LookAlike& other : others) sum += other.probability;
  for (LookAlike& other : others) other.probability /= sum;
  std::erase_if(others, [](const LookAlike& other) { return other.probability < kNegligible; });
  std::ranges::stable_sort(others, std::greater(), &LookAlike::probability);
  return others;
}

Candidate best_alike(const Sought& sought, const Candidate& candidate, const TakenPlaces& taken) {
  Candidates twins = make_twins(sought, candidate);
  twins.erase(refine_best(sought, twins), twins.end());
  Candidate best = candidate;
  double highest = 0;
  for (const Candidate& twin : twins) {
    if (!taken.is_clear(sought, twin.T_scene_model)) continue;
    const double lead = log_odds_over(sought, candidate, twin, highest);
    if (lead <= highest) continue;
    best = twin;
    highest = lead;
  }
  if (highest > 0) inherit(sought, candidate, best);
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

double log_odds_of_lead(double lead, const TwinTerms& terms) {
  return terms.lead_odds * bounded(lead, terms);
}

double lead_over(const Sought& sought, const Candidate& origin, const Candidate& twin) {
  const auto weigh = [&](const std::vector<std::uint32_t>& points, const Candidate& candidate) {
    return weigh_points(sought.model.cloud, points, sought.scan.surface, sought.scan.view,
                        candidate.T_scene_model, sought.params.tolerance, sought.terms.fit);
  };
  const NearSymmetry& symmetry = sought.model.near_symmetries.items[twin.near_symmetry];
  return lead_of(weigh(symmetry.carried_off, twin), weigh(symmetry.uncovered, origin));
}

}  // namespace posevote::poses
