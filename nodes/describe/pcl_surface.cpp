// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/describe/pcl_surface.hpp"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "graph/parallel.hpp"
#include "nodes/describe/feature_set.hpp"

namespace posevote {

PclSurface make_pcl_surface(const Cloud& cloud) {
  PclSurface surface;
  surface.points = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  surface.normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  const auto count = static_cast<std::size_t>(cloud.points.rows());
  surface.row_of.assign(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const auto point = static_cast<std::uint32_t>(i);
    if (!is_oriented(cloud, point)) continue;
    surface.row_of[i] = static_cast<int>(surface.points->size());
    surface.points->emplace_back(cloud.points(point, 0), cloud.points(point, 1),
                                 cloud.points(point, 2));
    surface.normals->emplace_back(cloud.normals(point, 0), cloud.normals(point, 1),
                                  cloud.normals(point, 2));
  }
  return surface;
}

Describable select_describable(const PclSurface& surface, const PointGrid& grid,
                               const FeaturePoints& points, float radius, int min_neighbours) {
  std::vector<char> enough(points.indices.size(), 0);
  graph::parallel_for(enough.size(), 64, [&](std::size_t i) {
    const int row = surface.row_of[points.indices[i]];
    if (row < 0) return;
    int others = -1;  // the point itself is found too
    grid.for_each_within((*surface.points)[static_cast<std::size_t>(row)].getVector3fMap(), radius,
                         [&others](std::uint32_t, float) { ++others; });
    enough[i] = others >= min_neighbours;
  });
  Describable describable;
  for (std::size_t i = 0; i < enough.size(); ++i) {
    if (!enough[i]) continue;
    describable.feature.push_back(i);
    describable.row.push_back(surface.row_of[points.indices[i]]);
  }
  return describable;
}

}  // namespace posevote
