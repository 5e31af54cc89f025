// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/outline.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "graph/parallel.hpp"
#include "nodes/geometry/extreme_points.hpp"
#include "nodes/geometry/grid.hpp"

namespace posevote::geometry {
namespace {

std::vector<std::uint8_t> ends_of(const Cloud& model, float reach) {
  std::vector<std::uint8_t> all(static_cast<std::size_t>(model.points.rows()));
  const float near = reach / 2;
  const PointGrid grid(model.points, near);
  graph::parallel_for(all.size(), 256, [&](std::size_t i) {
    std::uint8_t& ends = all[i];
    for (int k = 0; k < kOutlineDirections; ++k) {
      const Eigen::Vector3f place = place_ahead(model, static_cast<Eigen::Index>(i), k, reach);
      bool goes_on = false;
      grid.for_each_within(place, near, [&](std::uint32_t, float) { goes_on = true; });
      if (!goes_on) ends = static_cast<std::uint8_t>(ends | 1U << k);
    }
  });
  return all;
}

/// The other side of a sheet is around no bend.
std::vector<std::uint32_t> bends_of(const Cloud& model, float reach) {
  constexpr float kOtherFace = 0.7F;  // cosine, as between normals that do not agree
  if (reach == 0) return {};
  std::vector<std::uint32_t> all(static_cast<std::size_t>(model.points.rows()));
  const PointGrid grid(model.points, reach);
  graph::parallel_for(all.size(), 256, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    float nearest = reach * reach;
    all[i] = static_cast<std::uint32_t>(i);
    grid.for_each_within(
        model.points.row(row).transpose(), reach, [&](std::uint32_t other, float squared) {
          const float cosine =
              model.normals.row(row).dot(model.normals.row(static_cast<Eigen::Index>(other)));
          if (squared >= nearest || std::abs(cosine) >= kOtherFace) return;
          nearest = squared;
          all[i] = other;
        });
  });
  return all;
}

}  // namespace

Outline outline_of(const Cloud& model, float reach, float gap_reach, float bend_reach) {
  return {reach,
          ends_of(model, reach),
          gap_reach,
          ends_of(model, gap_reach),
          extreme_points(model.points).cast<float>(),
          bends_of(model, bend_reach)};
}

Eigen::Vector3f place_ahead(const Cloud& cloud, Eigen::Index i, int direction, float reach) {
  const Eigen::Vector3f normal = cloud.normals.row(i).transpose();
  const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
  const float angle =
      2 * std::numbers::pi_v<float> * static_cast<float>(direction) / kOutlineDirections;
  return cloud.points.row(i).transpose() + reach * (std::cos(angle) * u + std::sin(angle) * v);
}

}  // namespace posevote::geometry
