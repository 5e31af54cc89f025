// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/fields.hpp"

#include <algorithm>
#include <cmath>

namespace posevote::simulate {

double smooth_min(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * k * h * h;
}

double to_ball(const Eigen::Vector3d& p, const Ball& ball) {
  return (p - ball.center).norm() - ball.radius;
}

double to_limb(const Eigen::Vector3d& p, const Ball& a, const Ball& b) {
  const Eigen::Vector3d axis = b.center - a.center;
  const double along = std::clamp((p - a.center).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return to_ball(p, {a.center + along * axis, a.radius + along * (b.radius - a.radius)});
}

double to_chain(const Eigen::Vector3d& p, const std::vector<Ball>& balls, double k) {
  double nearest = to_limb(p, balls[0], balls[1]);
  for (std::size_t i = 1; i + 1 < balls.size(); ++i)
    nearest = smooth_min(nearest, to_limb(p, balls[i], balls[i + 1]), k);
  return nearest;
}

Waves::Waves(Random& random, int count, double frequency) {
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d direction = random.direction();
    const double length = frequency * random.uniform(1 / 1.5, 1.5);
    waves_.push_back({direction * length, random.uniform(0, 6.283185307179586)});
  }
}

double Waves::operator()(const Eigen::Vector3d& p) const {
  double sum = 0;
  for (const Wave& wave : waves_) sum += std::sin(wave.k.dot(p) + wave.phase);
  return sum / std::sqrt(static_cast<double>(waves_.size()));
}

double Relief::apply(double field, const Eigen::Vector3d& p) const {
  for (const Ball& bump : bumps) field = smooth_min(field, to_ball(p, bump), 0.12);
  for (const Ball& dent : dents) field = smooth_max(field, -to_ball(p, dent), 0.12);
  return field;
}

}  // namespace posevote::simulate
