// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/scan_surface.hpp"

#include <algorithm>
#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/select_rows.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::geometry {
namespace {

constexpr float kFarther = 2.5F;  // x reach: where ICP begins to look
constexpr float kPlace = 16;      // x reach: an edge of cubes whose points lie together

/// The finite points', cube by cube; as they are where there are no such cubes.
std::vector<std::uint32_t> rows_by_place(const PointMatrix& points, float edge) {
  constexpr float kLeast = 1e-6F;  // of what the points span: strays are no reason to fail
  std::vector<std::uint32_t> rows = finite_rows(points);
  if (!rows.empty()) edge = std::max(edge, kLeast * box_around(points, rows).sizes().maxCoeff());
  if (!(edge > 0) || !std::isfinite(edge)) return rows;
  return group_by_voxel(points, rows, edge).order;
}

}  // namespace

ScanSurface::ScanSurface(const Cloud& scan, bool single_view, float reach,
                         const SurfaceTerms& terms)
    : rows_(rows_by_place(scan.points, kPlace * reach)),
      gone_(static_cast<std::size_t>(scan.points.rows()), 1),
      viewpoint_(scan.view.origin),
      single_view_(single_view),
      facing_cosine_(static_cast<float>(terms.least_facing_cosine)),
      normal_cosine_(static_cast<float>(terms.least_normal_cosine)),
      reach_(reach) {
  const PointMatrix places = rows_of(scan.points, rows_);
  graph::parallel_for(2, 1, [&](std::size_t i) {
    (i == 0 ? near_ : far_) = NearestIndex(places, i == 0 ? reach : kFarther * reach);
  });
  points_.resize(rows_.size());
  graph::parallel_for(rows_.size(), 8192, [&](std::size_t k) {
    const std::uint32_t i = rows_[k];
    points_[k] = {scan.points.row(i).transpose(), scan.normals.row(i).transpose()};
    gone_[i] = static_cast<char>(!(points_[k].normal.squaredNorm() > 0.5F));
  });
  take_out(gone_);
}

void ScanSurface::take_out(const std::vector<char>& explained) {
  for (std::size_t i = 0; i < gone_.size(); ++i)
    gone_[i] = static_cast<char>(gone_[i] | explained[i]);
  std::vector<char> hidden;
  hidden.reserve(rows_.size());
  for (const std::uint32_t i : rows_) hidden.push_back(gone_[i]);
  near_.hide(hidden);
  far_.hide(hidden);
}

Posing ScanSurface::posing(const Eigen::Isometry3f& T_scene_model) const {
  Posing posing{};
  Eigen::Matrix3f::Map(&posing.rotation[0][0]) = T_scene_model.linear();
  Eigen::Vector3f::Map(posing.translation) = T_scene_model.translation();
  Eigen::Vector3f::Map(posing.viewpoint) = viewpoint_;
  posing.least_cosine = facing_cosine_;
  posing.single_view = single_view_;
  return posing;
}

NearestPoint ScanSurface::nearest_left(const Eigen::Vector3f& point, float distance) const {
  // What is found within reach spares a look at all that is farther.
  const NearestPoint near = near_.nearest(point, std::min(distance, reach_));
  return near || distance <= reach_ ? near : far_.nearest(point, distance);
}

std::optional<OrientedPoint> ScanSurface::nearest_compatible(const OrientedPoint& p,
                                                             float distance) const {
  const NearestPoint found = compatible(p, distance);
  if (!found) return std::nullopt;
  return points_[found.index];
}

std::optional<Eigen::Index> ScanSurface::compatible_row(const OrientedPoint& p,
                                                        float distance) const {
  const NearestPoint found = compatible(p, distance);
  if (!found) return std::nullopt;
  return rows_[found.index];
}

NearestPoint ScanSurface::compatible(const OrientedPoint& p, float distance) const {
  const NearestPoint nearest = nearest_left(p.point, distance);
  if (!nearest || points_[nearest.index].normal.dot(p.normal) < normal_cosine_) return {};
  return nearest;
}

}  // namespace posevote::geometry
