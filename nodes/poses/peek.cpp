// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/peek.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "graph/parallel.hpp"
#include "nodes/geometry/outline.hpp"
#include "nodes/geometry/spread.hpp"
#include "nodes/geometry/strewn.hpp"
#include "nodes/poses/candidate.hpp"

namespace posevote::poses {
namespace {

/// Of all looks beside supported points, those that meet the model's outline where the scan's is, as
/// of right detections (the median): it is not looked for here, and shows all of a flat side's pose.
constexpr double kUsualEnds = 0.07;

/// Supported is what faces the sensor at the range that it measured there.
Fit peek(const Sought& sought, const Eigen::Isometry3f& T_scene_model) {
  const Cloud& model = sought.model.cloud;
  const geometry::RangeView& view = sought.scan.view;
  const auto tolerance =
      static_cast<float>(sought.terms.schedule.glance_reach) * sought.params.tolerance;
  const geometry::Strewn rows(model.points.rows(), sought.terms.schedule.glance_points);
  Fit fit;
  Eigen::Matrix3f normals = Eigen::Matrix3f::Zero();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const geometry::OrientedPoint p = geometry::posed_point(model, rows[k], T_scene_model);
    const float cosine = sought.scan.surface.facing_cosine(p);
    if (cosine == 0) continue;
    ++fit.facing;
    const auto apparent = static_cast<double>(cosine);
    const float measured = view.measured_range(p.point);
    const float before = measured - (p.point - sought.scan.surface.viewpoint()).norm();
    if (measured == 0 && view.is_outside(p.point)) {
      ++fit.hidden;
    } else if (measured == 0) {
      ++fit.unseen, fit.apparent.mismatched += apparent;
    } else if (before > tolerance) {
      ++fit.contradicted, fit.apparent.contradicted += apparent;
    } else if (before < -tolerance) {
      ++fit.hidden;
    } else {
      ++fit.supported, fit.apparent.supported += apparent;
      normals += p.normal * p.normal.transpose();
    }
  }
  if (fit.supported == 0) return fit;
  const auto supported = static_cast<double>(fit.supported);
  fit.inlier_fraction = supported / static_cast<double>(fit.facing);
  fit.relief = geometry::relief_of(normals.cast<double>() / supported);
  fit.ends = static_cast<std::size_t>(kUsualEnds * geometry::kOutlineDirections * supported);
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
    const Fit fit = peek(sought, T_scene_model_of(one, sought.model.center).cast<float>());
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
