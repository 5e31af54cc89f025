// SPDX-License-Identifier: BSD-3-Clause
// Clouds of flat rectangles, and of a box that is made of them.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/geometry/cloud_of.hpp"

namespace posevote::test {

/// Points `spacing` apart on a rectangle of that size around `center`, its sides along u and v.
inline void add_rectangle(std::vector<Eigen::RowVector3f>& points,
                          std::vector<Eigen::RowVector3f>& normals, const Eigen::Vector3f& center,
                          const Eigen::Vector3f& u, const Eigen::Vector3f& v, float spacing) {
  const int columns = static_cast<int>(u.norm() / spacing),
            rows = static_cast<int>(v.norm() / spacing);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const float a = (static_cast<float>(i) + 0.5F) / static_cast<float>(columns) - 0.5F;
      const float b = (static_cast<float>(j) + 0.5F) / static_cast<float>(rows) - 0.5F;
      points.emplace_back((center + a * u + b * v).transpose());
      normals.emplace_back(u.cross(v).normalized().transpose());
    }
}

/// A box of size `size` [m] around the origin.
inline Cloud box_cloud(const Eigen::Vector3f& size, float spacing) {
  std::vector<Eigen::RowVector3f> points, normals;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3f out = 0.5F * size[axis] * Eigen::Vector3f::Unit(axis);
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const Eigen::Vector3f u = size[next] * Eigen::Vector3f::Unit(next);
    const Eigen::Vector3f v = size[last] * Eigen::Vector3f::Unit(last);
    add_rectangle(points, normals, out, u, v, spacing);
    add_rectangle(points, normals, -out, v, u, spacing);
  }
  return geometry::cloud_of(points, normals);
}

}  // namespace posevote::test
