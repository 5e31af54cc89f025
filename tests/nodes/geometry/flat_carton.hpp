// SPDX-License-Identifier: BSD-3-Clause
// A flat face: what slides along itself.
#pragma once

#include <cmath>

#include "nodes/data/cloud.hpp"

namespace posevote::test {

inline constexpr float kStep = 0.002F;
inline constexpr float kFar = 0.3F;  // behind the face

/// Points of a plane at depth z that look at the sensor in the origin.
inline void add_plane(Cloud& cloud, const Eigen::Vector2f& low, const Eigen::Vector2f& high,
                      float z) {
  const Eigen::Index columns = std::lround((high.x() - low.x()) / kStep);
  const Eigen::Index rows = std::lround((high.y() - low.y()) / kStep);
  const Eigen::Index before = cloud.points.rows(), added = columns * rows;
  cloud.points.conservativeResize(before + added, 3);
  cloud.normals.conservativeResize(before + added, 3);
  for (Eigen::Index i = 0; i < added; ++i) {
    cloud.points.row(before + i) << low.x() + kStep * static_cast<float>(i % columns),
        low.y() + kStep * static_cast<float>(i / columns), z;
    cloud.normals.row(before + i) << 0, 0, -1;
  }
}

/// The front of a carton, before a wall.
struct FlatCarton {
  Cloud model, scan;
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();

  FlatCarton() {
    add_plane(model, {-0.06F, -0.04F}, {0.06F, 0.04F}, 0);
    truth.translation() << 0.011, -0.007, 0.8;
    add_plane(scan, {-0.049F, -0.047F}, {0.071F, 0.033F}, 0.8F);
    add_plane(scan, {-0.2F, -0.2F}, {0.2F, 0.2F}, 0.8F + kFar);
  }
};

}  // namespace posevote::test
