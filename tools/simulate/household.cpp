// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/household.hpp"

#include <cmath>
#include <numbers>

#include "tools/simulate/cad_mesh.hpp"

namespace posevote::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

/// An outline in the x-z plane, drawn with z up, and how thick it is along y.
Mesh standing(const Outline& outline, double thick, const std::vector<Outline>& holes = {}) {
  CadMesh mesh;
  mesh.place(Eigen::Isometry3d(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitX())));
  mesh.prism(outline, -thick / 2, thick / 2, holes);
  return mesh.finish();
}

/// A cup whose wall is `wall` thick, and a bent bar from `low` to `high` whose ends stick in it.
Mesh with_handle(double radius, double wall, double low, double high, double reach, double bar) {
  CadMesh mesh;
  mesh.lathe({{radius, 0}, {radius, 1}, {radius - wall, 1}, {radius - wall, wall}}, 40);
  constexpr int kSteps = 8;
  std::vector<Ring> rings;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = kPi * (static_cast<double>(i) / kSteps - 0.5);  // from below, outward, up
    const double start = radius * std::cos(kPi / 40) - wall / 2;
    const Vector3d at(start + reach * std::cos(angle), 0,
                      (low + high) / 2 + (high - low) / 2 * std::sin(angle));
    const Vector3d out(std::cos(angle), 0, std::sin(angle));
    const Vector3d half = 0.5 * bar * out, side(0, 0.7 * bar, 0);
    rings.push_back({at - half - side, at + half - side, at + half + side, at - half + side});
  }
  mesh.tube(rings);
  return mesh.finish();
}

}  // namespace

Mesh tin(Random& random) {
  const double depth = random.uniform(0.55, 0.6);
  const Outline outline = rounded_rectangle(1, depth, 0.15, 5);
  const Outline lid = rounded_rectangle(0.94, depth - 0.06, 0.12, 5);
  CadMesh mesh;
  mesh.wall(outline, 0, 0.85);
  mesh.bottom(outline, 0);
  mesh.top(outline, 0.85, {lid});
  mesh.bore(lid, 0.81, 0.85);
  mesh.top(lid, 0.81);
  return mesh.finish();
}

Mesh bottle(Random& random) {
  const double shoulder = random.uniform(0.68, 0.72);
  CadMesh mesh;
  mesh.lathe({{0.22, 0},
              {0.24, 0.03},
              {0.24, shoulder},
              {0.2, shoulder + 0.06},
              {0.1, shoulder + 0.1},
              {0.09, 0.86},
              {0.11, 0.86},
              {0.1, 1}},
             28);
  return mesh.finish();
}

Mesh bowl(Random& random) {
  const double foot = random.uniform(0.36, 0.4);
  std::vector<Vector2d> outside{{foot, 0}}, inside;
  constexpr int kSteps = 6;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = kPi / 2 * i / kSteps;
    outside.emplace_back(foot + (1 - foot) * std::sin(angle), 0.06 + 0.6 * (1 - std::cos(angle)));
    if (i > 0)
      inside.emplace_back(foot - 0.04 + (1 - foot) * std::sin(angle),
                          0.1 + 0.56 * (1 - std::cos(angle)));
  }
  outside.insert(outside.end(), inside.rbegin(), inside.rend());
  CadMesh mesh;
  mesh.lathe(outside, 32);
  return mesh.finish();
}

Mesh mug(Random& random) {
  return with_handle(random.uniform(0.49, 0.52), 0.05, 0.2, 0.8, 0.3, 0.1);
}

Mesh pitcher(Random& random) {
  return with_handle(random.uniform(0.22, 0.24), 0.02, 0.3, 0.85, 0.12, 0.05);
}

Mesh banana(Random& random) {
  const double bend = random.uniform(1.1, 1.3);
  constexpr double kRadii[] = {0.03, 0.07, 0.1, 0.11, 0.11, 0.1, 0.08, 0.045, 0.03, 0.03};
  constexpr int kCount = 10;
  std::vector<Ring> rings;
  for (int i = 0; i < kCount; ++i) {
    const double angle = bend * (static_cast<double>(i) / (kCount - 1) - 0.5);
    const Vector3d out(std::cos(angle), 0, std::sin(angle));
    Ring ring;
    for (const Vector2d& corner : circle(10, kRadii[i]))
      ring.push_back(0.8 * out + corner.x() * out + Vector3d(0, corner.y(), 0));
    rings.push_back(ring);
  }
  CadMesh mesh;
  mesh.tube(rings);
  return mesh.finish();
}

Mesh drill(Random& random) {
  const double grip = random.uniform(0.3, 0.34);
  return standing({{0.1, 0},
                   {0.55, 0},
                   {0.55, 0.16},
                   {grip + 0.18, 0.18},
                   {grip + 0.15, 0.6},
                   {0.78, 0.64},
                   {0.82, 0.72},
                   {1, 0.76},
                   {1, 0.84},
                   {0.82, 0.88},
                   {0.75, 1},
                   {0.1, 1},
                   {0, 0.9},
                   {0, 0.7},
                   {0.12, 0.6},
                   {grip - 0.12, 0.18},
                   {0.1, 0.16}},
                  0.3);
}

Mesh scissors(Random& random) {
  const double open = random.uniform(0.04, 0.08);
  return standing({{0, -0.03},
                   {0.5, -0.06},
                   {0.6, -0.12},
                   {0.64, -0.26},
                   {0.76, -0.33},
                   {0.9, -0.28},
                   {0.95, -0.16},
                   {0.88, -0.04},
                   {0.76, 0},
                   {0.9, 0.05},
                   {0.98, 0.2},
                   {0.92, 0.34},
                   {0.78, 0.38},
                   {0.65, 0.3},
                   {0.6, 0.14},
                   {0.5, 0.07},
                   {0.02, open},
                   {0.3, 0}},
                  0.06, {circle(12, 0.1, {0.77, -0.17}), circle(12, 0.12, {0.79, 0.2})});
}

Mesh marker(Random& random) {
  const double cap = random.uniform(0.3, 0.34);
  CadMesh mesh;
  mesh.lathe({{0.055, 0}, {0.062, 0.02}, {0.062, 1 - cap}, {0.075, 1 - cap}, {0.07, 1}}, 24);
  return mesh.finish();
}

Mesh clamp(Random& random) {
  const double jaw = random.uniform(0.1, 0.13);
  return standing({{0.1, 0},
                   {0.3, 0},
                   {0.46, 0.42},
                   {0.54, 0.42},
                   {0.78, 0.04},
                   {0.96, 0.1},
                   {0.68, 0.56},
                   {0.8, 0.8},
                   {0.64, 1},
                   {0.5 + jaw / 2, 0.96},
                   {0.62, 0.8},
                   {0.5, 0.64},
                   {0.36, 0.8},
                   {0.5 - jaw / 2, 0.92},
                   {0.34, 0.98},
                   {0.18, 0.8},
                   {0.32, 0.56}},
                  0.2, {circle(12, 0.05, {0.5, 0.53})});
}

}  // namespace posevote::simulate
