// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/extreme_points.hpp"

#include <cmath>
#include <set>

namespace posevote::geometry {

Eigen::Matrix3Xd extreme_points(const PointMatrix& points) {
  constexpr int kDirections = 500;
  const double kGoldenAngle = M_PI * (3 - std::sqrt(5.0));
  std::set<Eigen::Index> chosen;
  for (int k = 0; k < kDirections && points.rows() > 0; ++k) {
    const double z = 1 - (2 * k + 1.0) / kDirections, ring = std::sqrt(1 - z * z);
    const Eigen::Vector3d direction(ring * std::cos(kGoldenAngle * k),
                                    ring * std::sin(kGoldenAngle * k), z);
    Eigen::Index outermost = 0;
    (points * direction.cast<float>()).maxCoeff(&outermost);
    chosen.insert(outermost);
  }
  Eigen::Matrix3Xd extreme(3, static_cast<Eigen::Index>(chosen.size()));
  Eigen::Index column = 0;
  for (const Eigen::Index i : chosen)
    extreme.col(column++) = points.row(i).transpose().cast<double>();
  return extreme;
}

double diameter_of(const PointMatrix& points) {
  const Eigen::Matrix3Xd ends = extreme_points(points);
  double most = 0;
  for (Eigen::Index i = 0; i < ends.cols(); ++i)
    most = std::max(most, (ends.colwise() - ends.col(i)).colwise().norm().maxCoeff());
  return most;
}

}  // namespace posevote::geometry
