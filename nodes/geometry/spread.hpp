// SPDX-License-Identifier: BSD-3-Clause
// How points spread about their mean, as far as a plane through them asks: the two smallest
// eigenvalues of their covariance and the direction that belongs to the smallest.
#pragma once

#include <Eigen/Core>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// The mean of points and their covariance about it.
struct Moments {
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
};

/// Of those rows, at least one, in one pass: far from the origin the first row keeps the digits.
template <class Rows>
Moments moments_of(const PointMatrix& points, const Rows& rows) {
  const auto point = [&points](auto row) -> Eigen::Vector3d {
    return points.row(static_cast<Eigen::Index>(row)).transpose().template cast<double>();
  };
  const Eigen::Vector3d first = point(rows.front());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto row : rows) {
    const Eigen::Vector3d off = point(row) - first;
    sum += off;
    squares += off * off.transpose();
  }
  const auto count = static_cast<double>(rows.size());
  const Eigen::Vector3d mean = sum / count;
  return {first + mean, squares / count - mean * mean.transpose()};
}

struct Spread {
  double least = 0;        ///< the smallest eigenvalue, at least 0
  double second = 0;       ///< the next; 0 where points lie on a line
  Eigen::Vector3d across;  ///< its eigenvector, not of unit length; 0 where points lie on a line:
                           ///< the second eigenvalue is at most 1e-4 of the third
};

/// The spread that a covariance tells: symmetric, no eigenvalue below 0 but by rounding. Where the two smallest are
/// alike, any direction between theirs. What is not finite lies on a line.
Spread spread_of(const Eigen::Matrix3d& covariance);

/// How much unit normals n differ: 1 - the largest eigenvalue of the mean of n n^T, 0 where all are
/// parallel, at most 2/3.
double relief_of(const Eigen::Matrix3d& mean_of_squares);

}  // namespace posevote::geometry
