// SPDX-License-Identifier: BSD-3-Clause
// Normals of raw points by principal component analysis, and the radius that suits the points.
//
// The plane through the neighbours within a radius, weighted by 1 - (distance / radius)^2 so that
// the rim, where other surfaces come in, counts little. Measured on the Bunny (mean error in deg,
// uniform displacement up to 0 / 1 / 2 / 3 % of the diagonal): 3 / 18 / 45 / 53 at 4 mm, 7 / 10 /
// 16 / 28 at 7.5 mm, 13 / 13 / 15 / 18 at 15 mm. So the radius follows from the noise.
#pragma once

#include <span>

#include "nodes/data/cloud.hpp"
#include "nodes/prepare/grid.hpp"
#include "nodes/prepare/voxels.hpp"

namespace posevote {

/// Fits planes to the neighbourhoods of a cloud. The points of a voxel of a fifth of the radius are
/// merged first and share a plane: a plane has some eighty neighbours however dense the cloud is.
class PlaneFitter {
 public:
  struct Plane {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, sign arbitrary; 0: no plane
    float thickness = 0;  ///< root mean square distance from the plane [m]
  };

  /// `radius` [m] > 0
  PlaneFitter(const PointMatrix& points, float radius);

  /// How many voxels there are.
  std::size_t size() const { return voxels_.size(); }
  /// The indices of the points in a voxel.
  std::span<const std::uint32_t> members(std::size_t voxel) const { return voxels_[voxel]; }

  /// The plane around the points of a voxel. None where fewer than `min_neighbours` voxels, or
  /// points on a line, leave it open.
  Plane fit(std::size_t voxel, int min_neighbours) const;

 private:
  float radius_;
  Voxels voxels_;
  PointMatrix centroids_;
  std::vector<float> sizes_;  // points in each voxel
  PointGrid grid_;
};

/// Plane normals of all points, sign arbitrary; (0, 0, 0) where there is none. Parallel.
PointMatrix plane_normals(const PointMatrix& points, float radius, int min_neighbours);

/// At least `smallest` and `spacings` times the points' own distance, and wide enough for the
/// noise: the typical neighbourhood is at most a fifth of its radius thick, unless that takes more
/// than four times the starting radius. 0 where all points coincide [m].
float suitable_radius(const PointMatrix& points, float smallest, float spacings);

/// The typical distance of a point to its nearest neighbour: the median over a sample [m].
float point_spacing(const PointMatrix& points);

}  // namespace posevote
