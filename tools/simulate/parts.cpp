// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/simulate/cad_mesh.hpp"

namespace posevote::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

double about(double value, Random& random) { return value * random.uniform(0.95, 1.05); }

/// A corner of the line in which two pipes of one width meet, or of an end; see `tee`.
struct Pipe {
  double radius, half_length, height;
  int corners;

  double angle(int i) const { return 2 * kPi * i / corners; }
  double y(int i) const { return radius * std::sin(angle(i)); }
  double lift(int i) const { return radius * std::cos(angle(i)); }
  Vector3d end(int i, double side) const { return {side * half_length, y(i), lift(i)}; }
  Vector3d seam(int i, double side) const {
    return {side * std::abs(lift(i)), y(i), std::abs(lift(i))};
  }
  /// Half way along the lower side, where it may need a corner, for the seam ends there.
  Vector3d below(int i) const { return {0, y(i), lift(i)}; }
  Vector3d mouth(int i) const { return {lift(i), y(i), height}; }
};

void add(CadMesh& mesh, Ring side, bool inward) {
  if (inward) std::reverse(side.begin(), side.end());
  mesh.polygon(side);
}

/// The surface of a pipe along x and of its branch along z, which meet in the planes x = +-z: there
/// prisms with the same outline share their edges exactly. Open at the three mouths.
void add_pipes(CadMesh& mesh, const Pipe& pipe, bool inward) {
  for (int i = 0; i < pipe.corners; ++i) {
    const int k = i + 1;
    const bool upper = pipe.lift(i) + pipe.lift(k) > 0;
    for (const double side : {-1.0, 1.0}) {
      Ring quad =
          upper ? Ring{pipe.seam(i, side), pipe.end(i, side), pipe.end(k, side), pipe.seam(k, side)}
                : Ring{pipe.below(i), pipe.end(i, side), pipe.end(k, side), pipe.below(k)};
      if (side < 0) std::reverse(quad.begin(), quad.end());
      add(mesh, quad, inward);
    }
    const double side = upper ? 1 : -1;
    add(mesh, {pipe.seam(i, side), pipe.seam(k, side), pipe.mouth(k), pipe.mouth(i)}, inward);
  }
}

}  // namespace

Mesh can(Random& random) {
  const double radius = about(0.35, random), height = about(1, random);
  CadMesh mesh;
  mesh.lathe(
      {{radius, 0}, {radius, height}, {radius - 0.03, height}, {radius - 0.03, height - 0.05}}, 40);
  return mesh.finish();
}

Mesh flange(Random& random) {
  const double thick = about(0.12, random), height = about(0.38, random);
  const Outline disc = circle(32, 0.6), hub = circle(24, about(0.26, random));
  const Outline bore = circle(24, 0.17);
  std::vector<Outline> holes;
  for (int i = 0; i < 4; ++i) {
    const double angle = kPi / 4 + i * kPi / 2;
    holes.push_back(circle(9, 0.065, 0.44 * Vector2d(std::cos(angle), std::sin(angle)), angle));
  }
  CadMesh mesh;
  mesh.wall(disc, 0, thick);
  mesh.wall(hub, thick, height);
  mesh.bore(bore, 0, height);
  mesh.top(hub, height, {bore});
  for (const Outline& hole : holes) mesh.bore(hole, 0, thick);
  std::vector<Outline> above = holes, below = holes;
  above.push_back(hub), below.push_back(bore);
  mesh.top(disc, thick, above);
  mesh.bottom(disc, 0, below);
  return mesh.finish();
}

Mesh bolt(Random& random) {
  const double length = about(0.6, random), radius = about(0.09, random), chamfer = 0.025;
  const Outline head = circle(6, 0.17), shaft = circle(24, radius);
  CadMesh mesh;
  mesh.wall(head, length, length + 0.12);
  mesh.top(head, length + 0.12);
  mesh.bottom(head, length, {shaft});
  mesh.wall(shaft, chamfer, length);
  Ring low, high;
  for (const Vector2d& corner : shaft) {
    high.emplace_back(corner.x(), corner.y(), chamfer);
    low.emplace_back(corner.x() * (1 - chamfer / radius), corner.y() * (1 - chamfer / radius), 0);
  }
  for (std::size_t i = 0; i < shaft.size(); ++i) {
    const std::size_t next = (i + 1) % shaft.size();
    mesh.polygon({low[i], low[next], high[next], high[i]});
  }
  mesh.polygon({low.rbegin(), low.rend()});
  return mesh.finish();
}

Mesh bracket(Random& random) {
  const double wide = about(0.5, random), thick = about(0.08, random), x = 1, z = 0.7;
  CadMesh mesh;
  // The sides, seen along y.
  const Outline angle{{0, 0}, {x, 0}, {x, thick}, {thick, thick}, {thick, z}, {0, z}};
  Eigen::Isometry3d sideways(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitX()));  // its z is -y
  mesh.place(sideways);
  mesh.top(angle, wide / 2);
  mesh.bottom(angle, -wide / 2);
  // A leg's face, its corners in order; the outlines of holes lie in it.
  mesh.place(Eigen::Isometry3d::Identity());
  const auto strip = [&](double from, double to) {
    return Outline{{from, -wide / 2}, {to, -wide / 2}, {to, wide / 2}, {from, wide / 2}};
  };
  const std::vector<Outline> lying{circle(16, 0.06, {0.7, 0.12}), circle(16, 0.06, {0.4, -0.12})};
  mesh.bottom(strip(0, x), 0, lying);
  mesh.top(strip(thick, x), thick, lying);
  for (const Outline& hole : lying) mesh.bore(hole, 0, thick);
  // The standing leg: outlines' x is -z, their z is x.
  Eigen::Isometry3d upright(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitY()));
  mesh.place(upright);
  const std::vector<Outline> standing{circle(20, 0.1, {-0.42, 0})};
  mesh.bottom(strip(-z, 0), 0, standing);
  mesh.top(strip(-z, -thick), thick, standing);
  for (const Outline& hole : standing) mesh.bore(hole, 0, thick);
  mesh.top(strip(-thick, 0), x);  // the ends of both legs
  mesh.place(Eigen::Isometry3d::Identity());
  mesh.top(strip(0, thick), z);
  return mesh.finish();
}

Mesh gear(Random& random) {
  const double thick = about(0.18, random), height = about(0.32, random);
  constexpr int kTeeth = 12;
  Outline teeth;
  for (int i = 0; i < kTeeth; ++i)
    for (const auto& [part, radius] :
         {std::pair(-0.32, 0.4), {-0.14, 0.5}, {0.14, 0.5}, {0.32, 0.4}}) {
      const double angle = 2 * kPi * (i + part) / kTeeth;
      teeth.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  const Outline hub = circle(24, about(0.2, random)), bore = circle(24, 0.12);
  CadMesh mesh;
  mesh.wall(teeth, 0, thick);
  mesh.wall(hub, thick, height);
  mesh.bore(bore, 0, height);
  mesh.top(hub, height, {bore});
  mesh.top(teeth, thick, {hub});
  mesh.bottom(teeth, 0, {bore});
  return mesh.finish();
}

Mesh tee(Random& random) {
  const double radius = about(0.22, random);
  const Pipe outer{radius, about(0.6, random), about(0.55, random), 20};
  Pipe inner = outer;
  inner.radius = radius - 0.05;
  CadMesh mesh;
  add_pipes(mesh, outer, false);
  add_pipes(mesh, inner, true);
  for (int i = 0; i < outer.corners; ++i) {
    const int k = i + 1;
    mesh.polygon({outer.mouth(i), outer.mouth(k), inner.mouth(k), inner.mouth(i)});
    mesh.polygon({outer.end(k, 1), outer.end(i, 1), inner.end(i, 1), inner.end(k, 1)});
    mesh.polygon({outer.end(i, -1), outer.end(k, -1), inner.end(k, -1), inner.end(i, -1)});
  }
  return mesh.finish();
}

Mesh carton(Random& random) {
  CadMesh mesh;
  mesh.prism(rectangle(0.55, about(0.9, random)), 0, about(1.4, random));
  return mesh.finish();
}

Mesh plate(Random& random) {
  CadMesh mesh;
  mesh.prism(rectangle(1.4, about(0.9, random)), 0, about(0.1, random),
             {circle(24, 0.16, {-0.4, 0.12}), circle(16, 0.08, {0.45, 0.25}),
              circle(16, 0.08, {0.45, -0.25}), circle(12, 0.05, {0.05, -0.28})});
  return mesh.finish();
}

}  // namespace posevote::simulate
