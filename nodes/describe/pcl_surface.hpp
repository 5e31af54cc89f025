// SPDX-License-Identifier: BSD-3-Clause
// The door to PCL's descriptors. Its headers stay out of this one: they cost seconds to compile.
#pragma once

#include <memory>
#include <vector>

#include "nodes/data/features.hpp"
#include "nodes/prepare/grid.hpp"

namespace pcl {
template <class Point>
class PointCloud;
struct PointXYZ;
struct Normal;
}  // namespace pcl

namespace posevote {

/// Those points of a cloud that have a finite position and a usable normal: PCL takes no others.
struct PclSurface {
  std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> points;
  std::shared_ptr<pcl::PointCloud<pcl::Normal>> normals;
  std::vector<int> row_of;  ///< of each point of the cloud: its index here, or -1
};

PclSurface make_pcl_surface(const Cloud& cloud);

/// Feature points that PCL can describe.
struct Describable {
  std::vector<std::size_t> feature;  ///< which of the feature points, ascending
  std::vector<int> row;              ///< its index in the surface
};

/// The feature points that are on the surface and have at least `min_neighbours` others within the
/// radius.
Describable select_describable(const PclSurface& surface, const PointGrid& grid,
                               const FeaturePoints& points, float radius, int min_neighbours);

}  // namespace posevote
