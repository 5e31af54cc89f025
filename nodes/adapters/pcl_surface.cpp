// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/adapters/pcl_surface.hpp"

#include <pcl/features/shot_lrf.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>

#include "graph/parallel.hpp"

namespace posevote::adapters {
namespace {

/// Estimations switch the sorting of a tree on; done once here, sharing it is only reading it.
template <class Point>
class SharedTree : public pcl::search::KdTree<Point> {
 public:
  SharedTree() : pcl::search::KdTree<Point>(true) {}
  void setSortedResults(bool /*sorted*/) override {}
};

}  // namespace

template <class Point>
std::shared_ptr<pcl::search::Search<Point>> shared_tree(
    const std::shared_ptr<pcl::PointCloud<Point>>& points) {
  if (points->empty()) return nullptr;  // PCL builds no tree over nothing
  auto tree = std::make_shared<SharedTree<Point>>();
  tree->setInputCloud(points);
  return tree;
}

template std::shared_ptr<pcl::search::Search<pcl::PointXYZ>> shared_tree(
    const std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>>& points);
template std::shared_ptr<pcl::search::Search<pcl::PointXYZRGB>> shared_tree(
    const std::shared_ptr<pcl::PointCloud<pcl::PointXYZRGB>>& points);

PclSurface make_pcl_surface(const Cloud& cloud) {
  PclSurface surface;
  surface.points = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  surface.normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  const auto count = static_cast<std::size_t>(cloud.points.rows());
  surface.row_of.assign(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const auto point = static_cast<std::uint32_t>(i);
    if (!descriptors::is_oriented(cloud, point)) continue;
    surface.row_of[i] = static_cast<int>(surface.points->size());
    surface.points->emplace_back(cloud.points(point, 0), cloud.points(point, 1),
                                 cloud.points(point, 2));
    // PCL's spin images throw at a normal that is not of unit length to the last digits.
    const Eigen::Vector3f normal = cloud.normals.row(point).transpose().normalized();
    surface.normals->emplace_back(normal.x(), normal.y(), normal.z());
  }
  return surface;
}

PclSupport::PclSupport(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                       double radius, int min_neighbours)
    : support_(cloud, points, scale, radius), surface_(make_pcl_surface(cloud)) {
  select(min_neighbours);
  tree_ = shared_tree(surface_.points);
}

void PclSupport::select(int min_neighbours) {
  const std::vector<std::uint32_t>& indices = support_.points().indices;
  std::vector<char> enough(indices.size(), 0);
  graph::parallel_for(enough.size(), 64, [&](std::size_t i) {
    const int row = surface_.row_of[indices[i]];
    if (row < 0) return;
    int others = -1;  // the point itself is found too
    grid().for_each_within((*surface_.points)[static_cast<std::size_t>(row)].getVector3fMap(),
                           radius(), [&others](std::uint32_t, float) { ++others; });
    enough[i] = others >= min_neighbours;
  });
  for (std::size_t i = 0; i < enough.size(); ++i) {
    if (!enough[i]) continue;
    feature_.push_back(i);
    row_.push_back(surface_.row_of[indices[i]]);
  }
}

void PclSupport::leave_out_unless(const std::vector<char>& usable) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < row_.size(); ++i) {
    if (!usable[static_cast<std::size_t>(row_[i])]) continue;
    feature_[kept] = feature_[i];
    row_[kept++] = row_[i];
  }
  feature_.resize(kept);
  row_.resize(kept);
}

PclRows PclSupport::chunk_of(std::size_t number, std::size_t chunk) const {
  const auto begin = row_.begin() + static_cast<std::ptrdiff_t>(number * chunk);
  const auto size =
      std::min<std::ptrdiff_t>(row_.end() - begin, static_cast<std::ptrdiff_t>(chunk));
  return std::make_shared<const std::vector<int>>(begin, begin + size);
}

FeatureSet PclSupport::describe(int length, std::size_t chunk, const Describe& function) const {
  const std::size_t count = support_.points().indices.size();
  DescriptorMatrix descriptors(static_cast<Eigen::Index>(count), length);
  std::vector<char> described(count, 0);
  graph::parallel_for((row_.size() + chunk - 1) / chunk, 1, [&](std::size_t number) {
    const PclRows rows = chunk_of(number, chunk);
    DescriptorMatrix result(static_cast<Eigen::Index>(rows->size()), length);
    function(rows, result);
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const std::size_t feature = feature_[number * chunk + i];
      descriptors.row(static_cast<Eigen::Index>(feature)) =
          result.row(static_cast<Eigen::Index>(i));
      described[feature] = 1;
    }
  });
  return descriptors::keep_described(support_.cloud(), support_.points(), std::move(descriptors),
                                     described);
}

void PclSupport::find_frames() {
  constexpr std::size_t kChunk = 64;
  frames_ = std::make_shared<pcl::PointCloud<pcl::ReferenceFrame>>();
  frames_->resize(surface_.points->size());
  std::vector<char> found(surface_.points->size(), 0);
  graph::parallel_for((row_.size() + kChunk - 1) / kChunk, 1, [&](std::size_t number) {
    const PclRows rows = chunk_of(number, kChunk);
    pcl::SHOTLocalReferenceFrameEstimation<pcl::PointXYZ, pcl::ReferenceFrame> estimation;
    estimation.setInputCloud(surface_.points);
    estimation.setIndices(rows);
    estimation.setSearchMethod(tree_);
    estimation.setRadiusSearch(static_cast<double>(radius()));
    pcl::PointCloud<pcl::ReferenceFrame> frames;
    estimation.compute(frames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto row = static_cast<std::size_t>((*rows)[i]);
      (*frames_)[row] = frames[i];
      const Eigen::Map<const Eigen::Array<float, 9, 1>> numbers(frames[i].rf);
      found[row] = numbers.isFinite().all();
    }
  });
  leave_out_unless(found);
}

std::shared_ptr<pcl::PointCloud<pcl::ReferenceFrame>> PclSupport::frames(
    const PclRows& rows) const {
  return std::make_shared<pcl::PointCloud<pcl::ReferenceFrame>>(*frames_, *rows);
}

}  // namespace posevote::adapters
