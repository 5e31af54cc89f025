// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/cad_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "nodes/formats/triangulate.hpp"

namespace posevote::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Whether two stretches cross or touch elsewhere than at ends that they share.
bool cross_each_other(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  if (a == c || a == d || b == c || b == d) return false;
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  return c_side * d_side <= 0 && a_side * b_side <= 0;
}

bool is_free(const Vector2d& a, const Vector2d& b, const std::vector<Outline>& outlines) {
  for (const Outline& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i)
      if (cross_each_other(a, b, outline[i], outline[(i + 1) % outline.size()])) return false;
  return true;
}

/// Whether the way from corner `at` of a counter-clockwise outline to `goal` starts inside of it.
bool starts_inside(const Outline& outline, std::size_t at, const Vector2d& goal) {
  const std::size_t n = outline.size();
  const Vector2d& here = outline[at];
  const Vector2d in = outline[(at + n - 1) % n] - here, out = outline[(at + 1) % n] - here;
  const Vector2d way = goal - here;
  const bool convex = cross(out, in) > 0;
  const bool left_of_out = cross(out, way) > 0, right_of_in = cross(way, in) > 0;
  return convex ? left_of_out && right_of_in : left_of_out || right_of_in;
}

/// Cuts the hole open along the shortest free way to the outline, and joins both to one polygon.
Outline open_hole(const Outline& outline, const Outline& hole,
                  const std::vector<Outline>& obstacles) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    for (std::size_t k = 0; k < hole.size(); ++k) {
      const double length = (outline[i] - hole[k]).norm();
      if (length >= least || !starts_inside(outline, i, hole[k]) ||
          !is_free(outline[i], hole[k], obstacles))
        continue;
      least = length, from = i, to = k;
    }
  if (!std::isfinite(least)) throw std::logic_error("a hole lies outside of its face");
  Outline joined(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(from) + 1);
  for (std::size_t k = 0; k <= hole.size(); ++k)  // clockwise, back to where it began
    joined.push_back(hole[(to + 2 * hole.size() - k) % hole.size()]);
  joined.insert(joined.end(), outline.begin() + static_cast<std::ptrdiff_t>(from), outline.end());
  return joined;
}

Outline open_holes(Outline outline, const std::vector<Outline>& holes) {
  std::vector<Outline> obstacles = holes;
  obstacles.push_back(outline);
  for (const Outline& hole : holes) {
    outline = open_hole(outline, hole, obstacles);
    obstacles.back() = outline;
  }
  return outline;
}

Ring at_height(const Outline& outline, double z) {
  Ring ring;
  for (const Vector2d& corner : outline) ring.emplace_back(corner.x(), corner.y(), z);
  return ring;
}

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

}  // namespace

Outline circle(int corners, double radius, const Vector2d& center, double phase) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = phase + 2 * std::numbers::pi * i / corners;
    outline.push_back(center + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

Outline rectangle(double width, double height) {
  const double x = width / 2, y = height / 2;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

Outline rounded_rectangle(double width, double height, double radius, int steps) {
  const double x = width / 2 - radius, y = height / 2 - radius;
  const Vector2d centers[4] = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
  Outline outline;
  for (int corner = 0; corner < 4; ++corner)
    for (int i = 0; i <= steps; ++i) {
      const double angle = std::numbers::pi / 2 * (corner + static_cast<double>(i) / steps);
      outline.push_back(centers[corner] + radius * Vector2d(std::cos(angle), std::sin(angle)));
    }
  return outline;
}

std::uint32_t CadMesh::vertex(const Vector3d& point) {
  constexpr double kSame = 1e-7;  // of the unit that the shapes are drawn in
  const auto place = [&](int axis) { return std::lround(point[axis] / kSame); };
  const auto [found, is_new] = vertex_at_.emplace(std::tuple(place(0), place(1), place(2)),
                                                  static_cast<std::uint32_t>(mesh_.points.size()));
  if (is_new) mesh_.points.push_back({point.x(), point.y(), point.z()});
  return found->second;
}

void CadMesh::polygon(const Ring& corners) {
  std::vector<std::uint32_t> list;
  for (const Vector3d& corner : corners) list.push_back(vertex(frame_ * corner));
  mesh_.add_polygon(list);
}

void CadMesh::top(const Outline& outline, double z, const std::vector<Outline>& holes) {
  polygon(at_height(open_holes(outline, holes), z));
}

void CadMesh::bottom(const Outline& outline, double z, const std::vector<Outline>& holes) {
  polygon(reversed(at_height(open_holes(outline, holes), z)));
}

void CadMesh::wall(const Outline& outline, double z0, double z1, bool inward) {
  const Ring low = at_height(outline, z0), high = at_height(outline, z1);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = (i + 1) % outline.size();
    const Ring side{low[i], low[next], high[next], high[i]};
    polygon(inward ? reversed(side) : side);
  }
}

void CadMesh::prism(const Outline& outline, double z0, double z1,
                    const std::vector<Outline>& holes) {
  wall(outline, z0, z1);
  for (const Outline& hole : holes) bore(hole, z0, z1);
  bottom(outline, z0, holes);
  top(outline, z1, holes);
}

void CadMesh::lathe(const std::vector<Vector2d>& profile, int corners) {
  std::vector<Ring> rings;
  for (const Vector2d& point : profile)
    rings.push_back(at_height(circle(corners, point.x()), point.y()));
  tube(rings);
}

void CadMesh::tube(const std::vector<Ring>& rings) {
  const std::size_t n = rings[0].size();
  for (std::size_t k = 0; k + 1 < rings.size(); ++k)
    for (std::size_t i = 0; i < n; ++i)
      polygon({rings[k][i], rings[k][(i + 1) % n], rings[k + 1][(i + 1) % n], rings[k + 1][i]});
  polygon(reversed(rings.front()));
  polygon(rings.back());
}

Mesh CadMesh::finish() {
  formats::mend_concave(mesh_);
  Mesh mesh;
  mesh.points.resize(static_cast<Eigen::Index>(mesh_.points.size()), 3);
  for (std::size_t i = 0; i < mesh_.points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      mesh.points(static_cast<Eigen::Index>(i), axis) =
          static_cast<float>(mesh_.points[i][static_cast<std::size_t>(axis)]);
  mesh.faces.resize(static_cast<Eigen::Index>(mesh_.faces.size()), 3);
  for (std::size_t i = 0; i < mesh_.faces.size(); ++i)
    for (int k = 0; k < 3; ++k)
      mesh.faces(static_cast<Eigen::Index>(i), k) = mesh_.faces[i][static_cast<std::size_t>(k)];
  return mesh;
}

}  // namespace posevote::simulate
