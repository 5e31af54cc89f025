// SPDX-License-Identifier: BSD-3-Clause
// Triangles of coarse meshes cut into small ones, where a triangle stands for a piece of surface.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// Calls visit(corners of a part, a column each) for the n^2 equal parts of a triangle, n so that
/// no edge of a part is longer than `longest`. Where n is 1, the corners are those given, exactly.
template <class Visit>
void for_each_part(const Eigen::Matrix3d& triangle, double longest, const Visit& visit) {
  const double edge = std::max({(triangle.col(1) - triangle.col(0)).norm(),
                                (triangle.col(2) - triangle.col(1)).norm(),
                                (triangle.col(0) - triangle.col(2)).norm()});
  const int n = std::max(1, static_cast<int>(std::ceil(edge / longest)));
  const auto at = [&](int i, int k) -> Eigen::Vector3d {
    return triangle * Eigen::Vector3d(n - i - k, i, k) / n;
  };
  Eigen::Matrix3d part;
  for (int i = 0; i < n; ++i)
    for (int k = 0; i + k < n; ++k) {
      part << at(i, k), at(i + 1, k), at(i, k + 1);
      visit(part);
      if (i + k + 2 > n) continue;
      part << at(i + 1, k), at(i + 1, k + 1), at(i, k + 1);
      visit(part);
    }
}

/// The length of the longest side of the bounding box.
inline double longest_side(const Mesh& mesh) {
  return double{(mesh.points.colwise().maxCoeff() - mesh.points.colwise().minCoeff()).maxCoeff()};
}

/// The corners of a face, a column each.
inline Eigen::Matrix3d corners_of(const Mesh& mesh, Eigen::Index face) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k)
    corners.col(k) = mesh.points.row(mesh.faces(face, k)).transpose().cast<double>();
  return corners;
}

}  // namespace posevote
