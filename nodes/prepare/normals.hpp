// SPDX-License-Identifier: BSD-3-Clause
// Normals from faces and from neighbourhoods, shared by the nodes for scans and for models.
#pragma once

#include "nodes/data/cloud.hpp"
#include "nodes/prepare/grid.hpp"

namespace posevote {

/// Area-weighted vertex normals by the faces' winding; (0, 0, 0) for vertices of no face.
PointMatrix face_normals(const PointMatrix& points, const FaceMatrix& faces);

/// Normals of the planes through the points within `radius` [m] (principal component analysis),
/// sign arbitrary; (0, 0, 0) where fewer than `min_neighbours` points (itself included) or points
/// on a line leave the plane open. Weighted by 1 - (distance / radius)^2, so that the rim, where
/// other surfaces come in, counts little. Parallel over points.
PointMatrix plane_normals(const PointMatrix& points, const PointGrid& grid, float radius,
                          int min_neighbours);

/// Makes every normal a unit vector, or (0, 0, 0) where it is not finite or shorter than 1e-12.
void normalise(PointMatrix& normals);

/// Turns each normal toward the viewpoint.
void turn_toward(const Eigen::Vector3f& viewpoint, const PointMatrix& points, PointMatrix& normals);

/// The points with a usable normal; the others are added to `dropped`. Faces are left behind:
/// nothing that follows needs them. Throws std::runtime_error if no point is left.
Cloud keep_oriented(const Cloud& cloud, const PointMatrix& normals);

/// The typical distance of a point to its nearest neighbour: the median over a sample [m].
float point_spacing(const PointMatrix& points);

}  // namespace posevote
