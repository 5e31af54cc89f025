// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/spread.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace posevote::geometry {
namespace {

constexpr int kMostSteps = 40;
constexpr double kStill = 1e-12;  // of the trace
constexpr double kLine = 1e-4;    // second eigenvalue over the third

/// Newton's iteration from 0 rises to the smallest root of the characteristic polynomial, which has
/// none below: five steps for a plane, where Eigen's closed form takes four times as long. Steps
/// only shrink, and the first is at most a ninth of the trace; one that grows is made of rounding,
/// where roots coincide.
double smallest_root(double trace, double minors, double determinant) {
  double root = 0, last = trace / 8;
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = ((trace - root) * root - minors) * root + determinant;
    const double slope = minors - (2 * trace - 3 * root) * root;
    const double rise = value / slope;
    if (!(slope > 0 && rise > kStill * trace && rise < last)) break;
    root += rise;
    last = rise;
  }
  return root;
}

}  // namespace

Spread spread_of(const Eigen::Matrix3d& m) {
  const double xy = m(0, 1) * m(0, 1), xz = m(0, 2) * m(0, 2), yz = m(1, 2) * m(1, 2);
  const double trace = m(0, 0) + m(1, 1) + m(2, 2);
  const double minors = m(0, 0) * m(1, 1) - xy + m(0, 0) * m(2, 2) - xz + m(1, 1) * m(2, 2) - yz;
  const double determinant = m(0, 0) * (m(1, 1) * m(2, 2) - yz) - xy * m(2, 2) - xz * m(1, 1) +
                             2 * m(0, 1) * m(0, 2) * m(1, 2);
  Spread spread{smallest_root(trace, minors, determinant), 0, Eigen::Vector3d::Zero()};
  // Sum and product of the two other eigenvalues tell their ratio.
  const double sum = trace - spread.least, product = minors - spread.least * sum;
  if (!(product > kLine * sum * sum)) return spread;
  spread.second = (sum - std::sqrt(std::max(sum * sum - 4 * product, 0.0))) / 2;
  const Eigen::Matrix3d left = m - spread.least * Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d across = left.col(i).cross(left.col((i + 1) % 3));
    if (across.squaredNorm() > spread.across.squaredNorm()) spread.across = across;
  }
  return spread;
}

double relief_of(const Eigen::Matrix3d& mean_of_squares) {
  // The eigenvalues sum up to one, so what the largest lacks is the least of the complement's.
  return spread_of(Eigen::Matrix3d::Identity() - mean_of_squares).least;
}

}  // namespace posevote::geometry
