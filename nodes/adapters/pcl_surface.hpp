// SPDX-License-Identifier: BSD-3-Clause
// The door to PCL's descriptors: what they work on, and the one loop that runs them. A descriptor
// node is then its PCL class and its registration. PCL's headers stay out of this one: they cost
// seconds to compile.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/descriptors/feature_set.hpp"

namespace pcl {
template <class Point>
class PointCloud;
struct PointXYZ;
struct Normal;
struct ReferenceFrame;
namespace search {
template <class Point>
class Search;
}
}  // namespace pcl

namespace posevote::adapters {

/// Those points of a cloud that have a finite position and a usable normal: PCL takes no others.
struct PclSurface {
  std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> points;
  std::shared_ptr<pcl::PointCloud<pcl::Normal>> normals;  ///< of unit length
  std::vector<int> row_of;  ///< of each point of the cloud: its index here, or -1
};

PclSurface make_pcl_surface(const Cloud& cloud);

/// A k-d tree over points (pcl::PointXYZ or PointXYZRGB), whose results are sorted by distance; null over
/// none. Threads may share it.
template <class Point>
std::shared_ptr<pcl::search::Search<Point>> shared_tree(
    const std::shared_ptr<pcl::PointCloud<Point>>& points);

/// Indices into a surface, as PCL takes them.
using PclRows = std::shared_ptr<const std::vector<int>>;

/// The neighbourhoods that a PCL descriptor looks at, in one cloud.
class PclSupport {
 public:
  /// `radius`: multiples of the resolution. Throws std::runtime_error where the cloud has no
  /// normals or what is asked for makes no sense: see require_describable.
  PclSupport(const Cloud& cloud, const FeaturePoints& points, const Scale& scale, double radius,
             int min_neighbours);

  const PclSurface& surface() const { return surface_; }
  const geometry::PointGrid& grid() const {
    return support_.grid();
  }  ///< over the cloud, not the surface
  float resolution() const { return support_.resolution(); }
  float radius() const { return support_.radius(); }

  /// The shared_tree of the surface's points.
  const std::shared_ptr<pcl::search::Search<pcl::PointXYZ>>& tree() const { return tree_; }

  /// Writes the descriptors of the surface's points `rows`, in their order, to the rows of the
  /// matrix.
  using Describe = std::function<void(const PclRows& rows, DescriptorMatrix& out)>;

  /// Describes in parallel, `chunk` feature points a call, those feature points that are on the
  /// surface and have at least `min_neighbours` others within the radius. A row that holds a NaN is
  /// left out. Throws std::runtime_error if none is left.
  FeatureSet describe(int length, std::size_t chunk, const Describe& function) const;

  /// Leaves out the feature points for which `usable`, a flag per surface point, is not set.
  void leave_out_unless(const std::vector<char>& usable);

  /// Finds SHOT's local reference frames of the feature points and leaves out those that have none.
  /// PCL's descriptors would find them too, but build a tree anew for that in every chunk, and
  /// write a line about every missing one.
  void find_frames();
  /// The frames of rows that are described, after find_frames.
  std::shared_ptr<pcl::PointCloud<pcl::ReferenceFrame>> frames(const PclRows& rows) const;

 private:
  void select(int min_neighbours);
  /// The feature points of chunk `number`.
  PclRows chunk_of(std::size_t number, std::size_t chunk) const;

  descriptors::Support support_;
  PclSurface surface_;
  std::shared_ptr<pcl::search::Search<pcl::PointXYZ>> tree_;
  std::vector<std::size_t> feature_;  ///< which of the feature points can be described, ascending
  std::vector<int> row_;              ///< its index in the surface
  std::shared_ptr<pcl::PointCloud<pcl::ReferenceFrame>> frames_;  ///< by index in the surface
};

/// Runs one of PCL's estimations over `rows` of `points`, of which there is a `tree`;
/// `values(point)` are a descriptor's numbers.
template <class Point, class Estimation, class Points, class Tree, class Values>
void run_estimation(Estimation& estimation, const Points& points, const Tree& tree, float radius,
                    const PclRows& rows, const Values& values, DescriptorMatrix& out) {
  estimation.setInputCloud(points);
  estimation.setIndices(rows);
  estimation.setSearchMethod(tree);
  estimation.setRadiusSearch(static_cast<double>(radius));
  pcl::PointCloud<Point> result;
  estimation.compute(result);
  if (result.size() != rows->size())
    throw std::runtime_error("PCL returned " + std::to_string(result.size()) + " descriptors for " +
                             std::to_string(rows->size()) + " points");
  for (std::size_t i = 0; i < result.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXf>(values(result[i]), out.cols());
}

/// Of a support's surface.
template <class Point, class Estimation, class Values>
void run_estimation(Estimation& estimation, const PclSupport& support, const PclRows& rows,
                    const Values& values, DescriptorMatrix& out) {
  run_estimation<Point>(estimation, support.surface().points, support.tree(), support.radius(),
                        rows, values, out);
}

}  // namespace posevote::adapters
