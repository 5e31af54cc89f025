// SPDX-License-Identifier: BSD-3-Clause
// What shapes are made of: fields of about the distance to a body, negative inside, and how to join
// them. The bodies live in a space of about [-1, 1]^3; their size comes later.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tools/simulate/random.hpp"

namespace posevote::simulate {

struct Ball {
  Eigen::Vector3d center;
  double radius;
};

/// Minimum with a rounded seam of width k (Quilez, "smooth minimum").
double smooth_min(double a, double b, double k);
inline double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }

double to_ball(const Eigen::Vector3d& p, const Ball& ball);
/// To the cone with round ends that joins the two balls (approximately).
double to_limb(const Eigen::Vector3d& p, const Ball& a, const Ball& b);
/// To a chain of limbs, joined smoothly.
double to_chain(const Eigen::Vector3d& p, const std::vector<Ball>& balls, double k);

/// Smooth noise in about [-1, 1]: a sum of plane waves of random direction and phase.
class Waves {
 public:
  /// `frequency`: radians per unit of length, varied by up to 1.5 times both ways.
  Waves(Random& random, int count, double frequency);
  double operator()(const Eigen::Vector3d& p) const;

 private:
  struct Wave {
    Eigen::Vector3d k;
    double phase;
  };
  std::vector<Wave> waves_;
};

/// Bumps added to and dents cut from a body.
struct Relief {
  std::vector<Ball> bumps, dents;
  double apply(double field, const Eigen::Vector3d& p) const;
};

}  // namespace posevote::simulate
