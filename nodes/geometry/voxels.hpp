// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Points grouped by voxel: `order` holds the points' indices, voxel v those from starts[v] to
/// starts[v + 1]; voxels in z-y-x order, points within a voxel in ascending order.
struct Voxels {
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> starts;

  std::size_t size() const { return starts.size() - 1; }
  /// The indices of the points in a voxel.
  std::span<const std::uint32_t> operator[](std::size_t voxel) const {
    return std::span(order).subspan(starts[voxel], starts[voxel + 1] - starts[voxel]);
  }
  /// Mean of the points of a voxel.
  Eigen::RowVector3d centroid(const PointMatrix& points, std::size_t voxel) const;
  /// Those of all voxels.
  PointMatrix centroids(const PointMatrix& points) const;
};

/// Sorts the points with the numbers `rows`, which are finite, into cubes of edge `leaf` [m] whose
/// corner is their own minimum: a cloud that is moved as a whole is grouped alike. Throws
/// std::runtime_error where they span more than four billion cubes along an axis.
Voxels group_by_voxel(const PointMatrix& points, const std::vector<std::uint32_t>& rows,
                      float leaf);

/// The same of all finite points.
Voxels group_by_voxel(const PointMatrix& points, float leaf);

}  // namespace posevote::geometry
