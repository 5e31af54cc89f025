// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/surface_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace posevote {

PointMatrix surface_points(const PointMatrix& points, const FaceMatrix& faces, Eigen::Index count) {
  const auto corner = [&](Eigen::Index face, int k) -> Eigen::RowVector3d {
    return points.row(faces(face, k)).cast<double>();
  };
  std::vector<double> area_to;  // of all faces up to one
  double area = 0;
  for (Eigen::Index face = 0; face < faces.rows(); ++face) {
    const Eigen::RowVector3d a = corner(face, 0);
    area += (corner(face, 1) - a).cross(corner(face, 2) - a).norm() / 2;
    area_to.push_back(area);
  }
  PointMatrix spread(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    const auto found = std::upper_bound(area_to.begin(), area_to.end() - 1,
                                        area * (n + 0.5) / static_cast<double>(count));
    const auto face = static_cast<Eigen::Index>(found - area_to.begin());
    // Steps by powers of the plastic number fill a square evenly (Roberts 2018); folded along its
    // diagonal it is a triangle.
    double u = n * 0.7548776662466927, v = n * 0.5698402909980532;
    u -= std::floor(u), v -= std::floor(v);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Eigen::RowVector3d a = corner(face, 0);
    spread.row(i) = (a + u * (corner(face, 1) - a) + v * (corner(face, 2) - a)).cast<float>();
  }
  return spread;
}

}  // namespace posevote
