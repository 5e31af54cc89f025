// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/describe/local_triangles.hpp"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "graph/parallel.hpp"

namespace posevote::describe {
namespace {

struct Neighbour2d {
  int row;
  Eigen::Vector2d at;  ///< in the tangent plane of the point in question
};

std::vector<Neighbour2d> project_neighbours(const adapters::PclSupport& support, int row,
                                            float reach) {
  const adapters::PclSurface& surface = support.surface();
  const auto point_of = [&](int i) {
    return (*surface.points)[static_cast<std::size_t>(i)].getVector3fMap();
  };
  const auto normal_of = [&](int i) {
    return (*surface.normals)[static_cast<std::size_t>(i)].getNormalVector3fMap();
  };
  const Eigen::Vector3f center = point_of(row), normal = normal_of(row);
  const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Neighbour2d> near;
  support.grid().for_each_within(center, reach, [&](std::uint32_t point, float squared) {
    const int neighbour = surface.row_of[point];
    if (neighbour < 0 || !(squared > 0) || normal.dot(normal_of(neighbour)) < 0.5F) return;
    const Eigen::Vector3f offset = point_of(neighbour) - center;
    near.push_back({neighbour, {offset.dot(u), offset.dot(v)}});
  });
  return near;
}

/// Whether no neighbour lies in the circle through the origin, a and b.
bool is_delaunay(const std::vector<Neighbour2d>& near, const Neighbour2d& a, const Neighbour2d& b,
                 double cross, double circumradius) {
  const double aa = a.at.squaredNorm(), bb = b.at.squaredNorm();
  const Eigen::Vector2d center =
      Eigen::Vector2d(b.at.y() * aa - a.at.y() * bb, a.at.x() * bb - b.at.x() * aa) / (2 * cross);
  const double squared = center.squaredNorm();
  if (!(squared <= circumradius * circumradius)) return false;
  return std::none_of(near.begin(), near.end(), [&](const Neighbour2d& other) {
    return (other.at - center).squaredNorm() < squared * (1 - 1e-6);
  });
}

}  // namespace

std::vector<std::array<int, 3>> local_triangles(const adapters::PclSupport& support,
                                                float circumradius) {
  std::vector<std::vector<std::array<int, 3>>> stars(support.surface().points->size());
  graph::parallel_for(stars.size(), 256, [&](std::size_t i) {
    // A circle through the point, no larger than that, lies within twice its radius.
    const int row = static_cast<int>(i);
    const std::vector<Neighbour2d> near = project_neighbours(support, row, 2 * circumradius);
    for (const Neighbour2d& a : near)
      for (const Neighbour2d& b : near) {
        const double cross = a.at.x() * b.at.y() - a.at.y() * b.at.x();
        if (!(cross > 0)) continue;
        if (!is_delaunay(near, a, b, cross, static_cast<double>(circumradius))) continue;
        std::array<int, 3> corners{row, a.row, b.row};
        std::sort(corners.begin(), corners.end());
        stars[i].push_back(corners);
      }
  });
  std::vector<std::array<int, 3>> triangles;
  for (const auto& star : stars) triangles.insert(triangles.end(), star.begin(), star.end());
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace posevote::describe
