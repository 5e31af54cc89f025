// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/peek.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "graph/parallel.hpp"
#include "nodes/geometry/outline.hpp"
#include "nodes/poses/measure_fit.hpp"

namespace posevote::poses {
namespace {

/// Of all looks beside supported points, those that meet the model's outline where the scan's is, as
/// of right detections (the median): it is not looked for here, and shows all of a flat side's pose.
constexpr double kUsualEnds = 0.07;

Fit peek(const Sought& sought, const Eigen::Isometry3d& T_scene_model) {
  Fit fit = measure_by_range(sought.model.cloud, sought.scan.surface, sought.scan.view,
                             T_scene_model, sought.params.tolerance,
                             sought.terms.schedule.glance_points, sought.terms.fit);
  fit.ends = static_cast<std::size_t>(kUsualEnds * geometry::kOutlineDirections *
                                      static_cast<double>(fit.supported));
  return fit;
}

}  // namespace

std::vector<std::size_t> worth_a_glance(const Sought& sought,
                                        const std::vector<Hypothesis>& proposals,
                                        const std::vector<std::size_t>& numbers) {
  const auto most = static_cast<std::size_t>(sought.terms.schedule.glances);
  if (numbers.size() <= most) return numbers;
  if (!sought.scan.view.usable() || sought.scan.takes > 0)
    return {numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(most)};
  struct Rank {
    double rank;
    std::size_t place;
  };
  std::vector<Rank> ranks(numbers.size());
  graph::parallel_for(ranks.size(), 32, [&](std::size_t i) {
    const Hypothesis& one = proposals[numbers[i]];
    const Fit fit = peek(sought, T_scene_model_of(one, sought.model.center));
    ranks[i] = {fit_quality(fit, sought.terms.fit) *
                    std::pow(one.support, sought.terms.score.trust_in_support),
                i};
  });
  std::ranges::stable_sort(ranks, std::greater(), &Rank::rank);
  ranks.resize(most);
  std::ranges::sort(ranks, std::less(), &Rank::place);
  std::vector<std::size_t> worth;
  for (const Rank& one : ranks) worth.push_back(numbers[one.place]);
  return worth;
}

}  // namespace posevote::poses
