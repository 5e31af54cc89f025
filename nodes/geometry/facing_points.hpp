// SPDX-License-Identifier: BSD-3-Clause
// The points of a posed model that turn their outside to the sensor, many at a time.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/facing_kernel.hpp"
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::geometry {

/// Calls visit(k, point, cosine) for each of the points rows[begin] to rows[end - 1] of a model that
/// faces the sensor once it is posed: `k` its place among `rows`, Strewn or a list of numbers,
/// `cosine` as of facing_cosine.
template <class Rows, class Visit>
void for_each_facing(const Cloud& model, const Rows& rows, std::size_t begin, std::size_t end,
                     const Eigen::Isometry3f& T_scene_model, const ScanSurface& scan,
                     const Visit& visit) {
  const Posing posing = scan.posing(T_scene_model);
  PointBatch batch;
  for (std::size_t first = begin; first < end; first += PointBatch::kCapacity) {
    const std::size_t count = std::min(PointBatch::kCapacity, end - first);
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = static_cast<Eigen::Index>(rows[first + i]);
      batch.x[i] = model.points(row, 0), batch.nx[i] = model.normals(row, 0);
      batch.y[i] = model.points(row, 1), batch.ny[i] = model.normals(row, 1);
      batch.z[i] = model.points(row, 2), batch.nz[i] = model.normals(row, 2);
    }
    pose_and_face(posing, batch, count);
    for (std::size_t i = 0; i < count; ++i)
      if (batch.cosine[i] > 0)
        visit(first + i,
              OrientedPoint{{batch.x[i], batch.y[i], batch.z[i]},
                            {batch.nx[i], batch.ny[i], batch.nz[i]}},
              batch.cosine[i]);
  }
}

}  // namespace posevote::geometry
