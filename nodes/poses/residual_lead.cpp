// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/residual_lead.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/plane_fit.hpp"
#include "nodes/poses/scan_points.hpp"

namespace posevote::poses {
namespace {

/// The distance of one of the scan's points from the surface of a posed model, at most `most`.
float off_surface(const Sought& sought, const Eigen::Isometry3f& T_model_scene, Eigen::Index row,
                  float most) {
  const std::optional<OnModel> on = find_on_model(sought, T_model_scene, row, most);
  if (!on) return most;
  return std::min(on->normals_agree ? std::abs(on->height) : on->away.norm(), most);
}

/// Rows of the scan that are left where one of two posed models is.
std::vector<Eigen::Index> rows_at(const Sought& sought, const Eigen::Isometry3d& one,
                                  const Eigen::Isometry3d& other) {
  const Eigen::Vector3d a = posed_center(one, sought.model.center),
                        b = posed_center(other, sought.model.center);
  const double tolerance = static_cast<double>(sought.params.tolerance);
  return rows_near(sought, (a + b) / 2, sought.reach + tolerance + (a - b).norm() / 2);
}

struct Off {
  float one, other;
};

}  // namespace

double residual_lead(const Sought& sought, const Eigen::Isometry3d& one,
                     const Eigen::Isometry3d& other) {
  const float near = sought.params.tolerance;
  const std::vector<Eigen::Index> rows = rows_at(sought, one, other);
  const Eigen::Isometry3f to_one = one.inverse().cast<float>(),
                          to_other = other.inverse().cast<float>();
  std::vector<Off> off(rows.size());
  graph::parallel_for(off.size(), kPointsGrain, [&](std::size_t i) {
    off[i] = {off_surface(sought, to_one, rows[i], near),
              off_surface(sought, to_other, rows[i], near)};
  });
  std::erase_if(off, [near](const Off& point) { return point.one >= near && point.other >= near; });
  std::vector<float> nearer;
  for (const Off& point : off) nearer.push_back(std::min(point.one, point.other));
  const TwinTerms& terms = sought.terms.twins;
  const double deviation = std::max(
      geometry::kDeviationOfMedian * static_cast<double>(geometry::upper_median(std::move(nearer))),
      terms.least_difference * static_cast<double>(near));
  constexpr double kMost = 3;  // deviations, from which on all are as far off
  double balance = 0, sides = 0;
  for (const Off& point : off) {
    const double a = std::min(static_cast<double>(point.one) / deviation, kMost),
                 b = std::min(static_cast<double>(point.other) / deviation, kMost);
    if (std::abs(a - b) < 1) continue;
    balance += b * b - a * a;
    sides += std::abs(b * b - a * a);
  }
  return sides > 0 ? balance / (2 * std::sqrt(terms.err_alike * sides)) : 0;
}

}  // namespace posevote::poses
