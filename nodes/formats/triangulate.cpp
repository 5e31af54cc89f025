// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace posevote::formats {
namespace {

constexpr std::size_t kMostCorners = 1000;

using Triangle = std::array<std::uint32_t, 3>;

struct Corner {
  std::uint32_t vertex = 0;
  Eigen::Vector3d point;
};
using Polygon = std::vector<Corner>;

Polygon corners_of(const RawMesh& mesh, const Fan& fan) {
  Polygon polygon;
  const auto add = [&](std::uint32_t vertex) {
    const Triple& p = mesh.points[vertex];
    polygon.push_back({vertex, {p[0], p[1], p[2]}});
  };
  add(mesh.faces[fan.first][0]);
  add(mesh.faces[fan.first][1]);
  for (std::size_t i = 0; i < fan.count; ++i) add(mesh.faces[fan.first + i][2]);
  return polygon;
}

Eigen::Vector3d normal_of(const Corner& a, const Corner& b, const Corner& c) {
  return (b.point - a.point).cross(c.point - a.point);
}

/// Twice the polygon's area along its normal, summed over its fan.
Eigen::Vector3d normal_of(const Polygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += normal_of(polygon[0], polygon[i - 1], polygon[i]);
  return sum;
}

bool is_reversed(const Corner& a, const Corner& b, const Corner& c, const Eigen::Vector3d& normal) {
  return normal_of(a, b, c).dot(normal) < 0;
}

bool fan_is_right(const Polygon& polygon, const Eigen::Vector3d& normal) {
  for (std::size_t i = 2; i < polygon.size(); ++i)
    if (is_reversed(polygon[0], polygon[i - 1], polygon[i], normal)) return false;
  return true;
}

/// Whether the triangle before, at and after a corner lies within the polygon.
bool is_ear(const Polygon& polygon, std::size_t at, const Eigen::Vector3d& normal) {
  const std::size_t n = polygon.size();
  const Corner &a = polygon[(at + n - 1) % n], &b = polygon[at], &c = polygon[(at + 1) % n];
  if (!(normal_of(a, b, c).dot(normal) > 0)) return false;
  for (const Corner& other : polygon) {
    // The polygon may touch itself, where a hole is cut open.
    if (other.point == a.point || other.point == b.point || other.point == c.point) continue;
    if (!is_reversed(a, b, other, normal) && !is_reversed(b, c, other, normal) &&
        !is_reversed(c, a, other, normal))
      return false;
  }
  return true;
}

/// Fewer triangles than the polygon needs where it crosses itself.
std::vector<Triangle> clip_ears(Polygon polygon, const Eigen::Vector3d& normal) {
  std::vector<Triangle> triangles;
  for (std::size_t tried = 0, at = 0; polygon.size() > 3 && tried < polygon.size();) {
    const std::size_t n = polygon.size();
    at %= n;
    if (!is_ear(polygon, at, normal)) {
      ++tried, ++at;
      continue;
    }
    triangles.push_back(
        {polygon[(at + n - 1) % n].vertex, polygon[at].vertex, polygon[(at + 1) % n].vertex});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(at));
    tried = 0;
  }
  if (polygon.size() == 3)
    triangles.push_back({polygon[0].vertex, polygon[1].vertex, polygon[2].vertex});
  return triangles;
}

}  // namespace

void mend_concave(RawMesh& mesh) {
  for (const Fan& fan : mesh.fans) {
    if (fan.count + 2 > kMostCorners) continue;
    const Polygon polygon = corners_of(mesh, fan);
    const Eigen::Vector3d normal = normal_of(polygon);
    if (!normal.allFinite() || fan_is_right(polygon, normal)) continue;
    const std::vector<Triangle> triangles = clip_ears(polygon, normal);
    if (triangles.size() == fan.count)
      std::copy(triangles.begin(), triangles.end(),
                mesh.faces.begin() + static_cast<std::ptrdiff_t>(fan.first));
  }
}

}  // namespace posevote::formats
