// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/parallel.hpp"
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

/// Extent along one axis without a share of the points at either end [m].
inline double robust_extent(const PointMatrix& points, Eigen::Index axis, double outliers) {
  std::vector<float> values(points.col(axis).begin(), points.col(axis).end());
  const auto out = static_cast<std::ptrdiff_t>(outliers * static_cast<double>(values.size()));
  const auto nth = [&values](std::ptrdiff_t n) {
    std::nth_element(values.begin(), values.begin() + n, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(n)]);
  };
  return nth(std::ssize(values) - 1 - out) - nth(out);
}

/// The same of the bounding box's diagonal. Of at least one point.
inline double robust_diagonal(const PointMatrix& points, double outliers) {
  Eigen::Vector3d extent;
  graph::parallel_for(3, 1, [&](std::size_t axis) {
    const auto column = static_cast<Eigen::Index>(axis);
    extent[column] = robust_extent(points, column, outliers);
  });
  return extent.norm();
}

}  // namespace posevote::geometry
