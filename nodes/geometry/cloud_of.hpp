// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// The cloud of as many points as normals, and colours, or none.
inline Cloud cloud_of(const std::vector<Eigen::RowVector3f>& points,
                      const std::vector<Eigen::RowVector3f>& normals,
                      const std::vector<Eigen::RowVector3f>& colors = {}) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Cloud cloud{PointMatrix(count, 3), PointMatrix(count, 3), {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.points.row(static_cast<Eigen::Index>(i)) = points[i];
    cloud.normals.row(static_cast<Eigen::Index>(i)) = normals[i];
  }
  cloud.colors.resize(std::ssize(colors), 3);
  for (std::size_t i = 0; i < colors.size(); ++i)
    cloud.colors.row(static_cast<Eigen::Index>(i)) = colors[i];
  return cloud;
}

}  // namespace posevote::geometry
