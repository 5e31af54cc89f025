// SPDX-License-Identifier: BSD-3-Clause
// How points spread about their mean, as far as a plane through them asks: the two smallest
// eigenvalues of their covariance and the direction that belongs to the smallest.
#pragma once

#include <Eigen/Core>

namespace posevote::geometry {

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
