// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// The cloud of as many points as normals.
inline Cloud cloud_of(const std::vector<Eigen::RowVector3f>& points,
                      const std::vector<Eigen::RowVector3f>& normals) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Cloud cloud{PointMatrix(count, 3), PointMatrix(count, 3), {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.points.row(static_cast<Eigen::Index>(i)) = points[i];
    cloud.normals.row(static_cast<Eigen::Index>(i)) = normals[i];
  }
  return cloud;
}

}  // namespace posevote::geometry
