// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Diagonal of the bounding box of a model's points [m]. Throws std::runtime_error where it is not
/// finite and above 0.
inline double model_diagonal(const PointMatrix& points) {
  Eigen::RowVector3d extent = Eigen::RowVector3d::Zero();
  if (points.rows() > 0)
    extent =
        points.colwise().maxCoeff().cast<double>() - points.colwise().minCoeff().cast<double>();
  const double diagonal = extent.norm();
  if (!(diagonal > 0) || !std::isfinite(diagonal))
    throw std::runtime_error("has " + std::to_string(points.rows()) +
                             " points and no extent: expected a surface");
  return diagonal;
}

}  // namespace posevote::geometry
