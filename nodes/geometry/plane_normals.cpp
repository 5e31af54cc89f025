// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/plane_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/plane_moments.hpp"
#include "nodes/geometry/point_spacing.hpp"

namespace posevote::geometry {
namespace {

constexpr float kMergePerRadius = 1.0F / 5;

std::vector<float> weights_of(const Voxels& voxels, const PointGrid& grid) {
  std::vector<float> weights(voxels.size() + kGridPadding, 0);
  for (std::size_t i = 0; i < grid.size(); ++i)
    weights[i] = static_cast<float>(voxels[grid.indices()[i]].size());
  return weights;
}

}  // namespace

PlaneFitter::PlaneFitter(const PointMatrix& points, float radius)
    : radius_(radius),
      point_count_(points.rows()),
      voxels_(group_by_voxel(points, radius * kMergePerRadius)),
      centroids_(voxels_.centroids(points)),
      grid_(centroids_, radius),
      weights_(weights_of(voxels_, grid_)) {}

Plane PlaneFitter::fit(std::size_t voxel, int min_neighbours) const {
  const Eigen::Vector3f center = centroids_.row(static_cast<Eigen::Index>(voxel));
  std::vector<GridRun> around;
  grid_.find_runs(center, center, radius_, around);
  return fit(voxel, around, min_neighbours);
}

Plane PlaneFitter::fit(std::size_t voxel, const std::vector<GridRun>& around,
                       int min_neighbours) const {
  const Eigen::Vector3f center = centroids_.row(static_cast<Eigen::Index>(voxel));
  const PlaneMoments moments = plane_moments({grid_.x(), grid_.y(), grid_.z(), weights_.data()},
                                             around.data(), around.size(), center.data(), radius_);
  return plane_of(moments, radius_, min_neighbours);
}

PointMatrix PlaneFitter::normals(int min_neighbours) const {
  PointMatrix normals = PointMatrix::Zero(point_count_, 3);
  // Voxels side by side share one look into the grid: it would cost more than the sums.
  const std::vector<GridRun> pieces = grid_.pieces(radius_);
  graph::parallel_for(pieces.size(), 16, [&](std::size_t p) {
    thread_local std::vector<GridRun> around;
    Eigen::AlignedBox3f box;
    for (std::uint32_t i = pieces[p].begin; i < pieces[p].end; ++i)
      box.extend(centroids_.row(grid_.indices()[i]).transpose());
    grid_.find_runs(box.min(), box.max(), radius_, around);
    for (std::uint32_t i = pieces[p].begin; i < pieces[p].end; ++i) {
      const std::uint32_t voxel = grid_.indices()[i];
      const Eigen::Vector3f normal = fit(voxel, around, min_neighbours).normal;
      for (const std::uint32_t point : voxels_[voxel]) normals.row(point) = normal;
    }
  });
  return normals;
}

std::optional<PlaneFitter> suitable_planes(const PointMatrix& points, float smallest,
                                           float spacings) {
  const float spacing = point_spacing(points);
  if (!(spacing > 0)) return std::nullopt;
  const float start = std::max(smallest, spacings * spacing);
  std::optional<PlaneFitter> planes;
  const float radius = suitable_radius(start, [&](float tried) {
    planes.emplace(points, tried);
    return typical_thickness(planes->size(),
                             [&](std::size_t v, int least) { return planes->fit(v, least); });
  });
  if (!planes || planes->radius() != radius) planes.emplace(points, radius);
  return planes;
}

}  // namespace posevote::geometry
