// SPDX-License-Identifier: BSD-3-Clause
// What the nodes that make normals, of scans and of models, share.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Area-weighted vertex normals by the faces' winding; (0, 0, 0) for vertices of no face, or only
/// of faces without area. Throws std::runtime_error if a face has a corner that is no point.
PointMatrix face_normals(const PointMatrix& points, const FaceMatrix& faces);

/// Makes every normal a unit vector, or (0, 0, 0) where it is not finite or shorter than 1e-12.
void normalise(PointMatrix& normals);

/// Turns each normal toward the sensor.
void turn_toward(const Eigen::Vector3f& sensor, const PointMatrix& points, PointMatrix& normals);

/// The numbers of the finite points with a finite normal other than (0, 0, 0). Throws
/// std::runtime_error if there are none.
std::vector<std::uint32_t> oriented_rows(const PointMatrix& points, const PointMatrix& normals);

/// Those of the points that oriented_rows finds. Throws as it does.
Cloud keep_oriented(const PointMatrix& points, PointMatrix normals, const View& view = {},
                    const ColorMatrix& colors = {});

/// Throws std::runtime_error if the points have no normals.
void require_normals(const Cloud& cloud);

/// Throws std::runtime_error if a face has a corner that is no point.
void check_faces(const PointMatrix& points, const FaceMatrix& faces);

}  // namespace posevote::geometry
