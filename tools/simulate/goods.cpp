// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/goods.hpp"

#include <algorithm>
#include <cmath>

#include "tools/simulate/fields.hpp"

namespace posevote::simulate {
namespace {

using Eigen::Vector3d;

constexpr double kSeam = 0.04;  // fillets between parts

double join(std::initializer_list<double> parts) {
  double nearest = 10;
  for (const double part : parts) nearest = smooth_min(nearest, part, kSeam);
  return nearest;
}

/// A box with rounded edges; `half` includes the rounding.
double to_box(const Vector3d& p, const Vector3d& center, const Vector3d& half, double rounding) {
  const Vector3d q = (p - center).cwiseAbs() - half + Vector3d::Constant(rounding);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - rounding;
}

/// A cylinder along `axis` (unit), half as long as `half`, with rounded rims.
double to_cylinder(const Vector3d& p, const Vector3d& center, const Vector3d& axis, double radius,
                   double half, double rounding) {
  const double along = (p - center).dot(axis);
  const double around = ((p - center) - along * axis).norm();
  const Eigen::Vector2d q(around - radius + rounding, std::abs(along) - half + rounding);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - rounding;
}

double around_z(const Vector3d& p) { return std::sqrt(p.x() * p.x() + p.y() * p.y()); }

/// What lies on the far side of the plane through `point` is cut away.
double cut(double field, const Vector3d& p, const Vector3d& point, const Vector3d& normal) {
  return smooth_max(field, (p - point).dot(normal.normalized()), kSeam);
}

}  // namespace

Field cup(Random& random) {
  constexpr double kWall = 0.075;
  const double bottom = random.uniform(0.5, 0.58), top = random.uniform(0.7, 0.78);
  return [=](const Vector3d& p) {
    const double radius = bottom + (top - bottom) * (p.z() + 1) / 2;
    const double off = around_z(p) - radius;
    const double solid = smooth_max(off, std::abs(p.z()) - 1, kSeam);
    const double hollow = smooth_max(off + kWall, -0.88 - p.z(), kSeam);
    const double rim = std::hypot(around_z(p) - top, p.z() - 0.95) - 0.065;
    return smooth_min(std::max(solid, -hollow), rim, 0.02);
  };
}

Field juice(Random& random) {
  const Vector3d half(random.uniform(0.5, 0.56), random.uniform(0.33, 0.38), 0.9);
  const double slant = random.uniform(0.25, 0.35);
  return [=](const Vector3d& p) {
    double body = to_box(p, {0, 0, -0.1}, half, 0.04);
    body = cut(body, p, {0, 0, 0.68}, {slant, 0, 1});  // the top slopes
    const double fold = to_box(p, {0, 0, 0.75}, {half.x() * 0.9, 0.035, 0.2}, 0.03);
    const double cap = to_cylinder(p, {0.28, -0.17, 0.66}, {0, 0, 1}, 0.13, 0.14, 0.03);
    return join({body, fold, cap});
  };
}

Field milk(Random& random) {
  const double half = random.uniform(0.4, 0.45), pitch = random.uniform(0.9, 1.1);
  return [=](const Vector3d& p) {
    double body = to_box(p, {0, 0, -0.15}, {half, half, 0.85}, 0.03);
    const Vector3d eaves(0, half, 0.35);
    body = cut(body, p, eaves, {0, pitch, 1});
    body = cut(body, p, {0, -half, 0.35}, {0, -pitch, 1});
    const double ridge = to_box(p, {0, 0, 0.8}, {half, 0.035, 0.2}, 0.03);
    const Vector3d slope = Vector3d(0, pitch, 1).normalized();
    const double cap =
        to_cylinder(p, Vector3d(0, 0.25, 0.35 + pitch * (half - 0.25)), slope, 0.15, 0.11, 0.03);
    return join({body, ridge, cap});
  };
}

Field shampoo(Random& random) {
  const double width = random.uniform(0.44, 0.5), depth = random.uniform(0.22, 0.27);
  const double waist = random.uniform(0.08, 0.14), lean = random.uniform(0.08, 0.14);
  return [=](const Vector3d& p) {
    const double taper = 1 - waist * std::cos(3 * (p.z() + 0.2)) - 0.1 * p.z();
    const double x = (p.x() - lean * p.z()) / (width * taper), y = p.y() / (depth * taper);
    double body = 0.8 * depth * (std::sqrt(x * x + y * y) - 1);
    body = smooth_max(body, std::abs(p.z() + 0.2) - 0.75, 0.3);
    const Vector3d neck(lean * 0.7, 0, 0.7);
    const double cap = to_cylinder(p, neck, {0, 0, 1}, 0.19, 0.3, 0.05);
    const double nozzle = to_box(p, {neck.x() + 0.2, 0, 0.92}, {0.2, 0.08, 0.06}, 0.04);
    return join({body, cap, nozzle});
  };
}

Field joystick(Random& random) {
  const Vector3d lean(random.uniform(-0.3, 0.3), random.uniform(0.1, 0.3), 0);
  const double turn = random.uniform(-0.12, 0.12);
  return [=](const Vector3d& p) {
    const double base = to_box(p, {0, 0, -0.85}, {0.62, 0.68, 0.15}, 0.1);
    const double boot = to_limb(p, {{0, 0, -0.75}, 0.32}, {{0, 0, -0.55}, 0.16});
    const std::vector<Ball> stick{{{0, 0, -0.6}, 0.13},
                                  {lean * 0.5 + Vector3d(turn, 0, 0.1), 0.14},
                                  {lean + Vector3d(0, 0, 0.75), 0.2}};
    const Vector3d head = lean + Vector3d(0, 0, 0.85);
    const double hat = to_cylinder(p, head + Vector3d(0, 0.02, 0.1), {0, 0, 1}, 0.1, 0.12, 0.03);
    const double trigger =
        to_limb(p, {head + Vector3d(0.05, -0.25, -0.1), 0.08}, {head + Vector3d(0, -0.1, 0), 0.08});
    const double rest = to_box(p, head + Vector3d(-0.25, 0, -0.15), {0.15, 0.12, 0.05}, 0.04);
    const double button = to_cylinder(p, {0.4, -0.42, -0.7}, {0, 0, 1}, 0.12, 0.08, 0.03);
    const double slider = to_box(p, {-0.42, -0.3, -0.7}, {0.06, 0.2, 0.08}, 0.03);
    return join({base, boot, to_chain(p, stick, 0.08), hat, trigger, rest, button, slider});
  };
}

Field camera(Random& random) {
  const Vector3d half(0.95, random.uniform(0.26, 0.34), random.uniform(0.55, 0.65));
  const double lens = random.uniform(0.36, 0.44), at = random.uniform(0.08, 0.2);
  return [=](const Vector3d& p) {
    const double body = to_box(p, {0, 0, -0.1}, half, 0.08);
    const double front = half.y() + 0.2;
    const double barrel = to_cylinder(p, {at, front, -0.12}, {0, 1, 0}, lens, 0.24, 0.04);
    const double glass =
        to_cylinder(p, {at, front + 0.24, -0.12}, {0, 1, 0}, lens - 0.1, 0.12, 0.02);
    const double grip = to_limb(p, {{-0.75, half.y(), -0.5}, 0.15}, {{-0.75, half.y(), 0.3}, 0.15});
    const double finder = to_box(p, {at, -0.02, half.z()}, {0.24, half.y() * 0.8, 0.2}, 0.06);
    const double shutter = to_cylinder(p, {-0.65, 0, half.z() - 0.06}, {0, 0, 1}, 0.13, 0.12, 0.03);
    return std::max(join({body, barrel, grip, finder, shutter}), -glass);
  };
}

}  // namespace posevote::simulate
