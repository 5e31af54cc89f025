// SPDX-License-Identifier: BSD-3-Clause
// SHOT (Tombari, Salti, Di Stefano, ECCV 2010; PCL's code): histograms of normals over the cells of
// a sphere around the feature point, in a repeatable local frame. 352 numbers.
//
// Chunks of feature points are described in parallel, each by PCL objects of its own that share one
// k-d tree. The frames are computed apart, because SHOTEstimation would build a tree for them anew
// in every chunk.
//
// Left out are feature points without a usable normal, with fewer than `min_neighbours` neighbours,
// or for which PCL finds no frame. Fails if none is left. Time: O(feature points x neighbours).
//
//   describe_shot: {in: [cloud, points, scale], out: features, radius: 20}
#include <pcl/features/shot.h>
#include <pcl/features/shot_lrf.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/describe/feature_set.hpp"
#include "nodes/describe/pcl_surface.hpp"

namespace posevote {
namespace {

struct Params {
  double radius = 20;
  int min_neighbours = 10;
};

constexpr std::size_t kChunk = 64;
constexpr int kLength = 352;

using Tree = pcl::search::KdTree<pcl::PointXYZ>;
using Frames = pcl::PointCloud<pcl::ReferenceFrame>;

Frames::Ptr local_frames(const PclSurface& surface, const Tree::Ptr& tree,
                         const pcl::IndicesConstPtr& rows, double radius) {
  pcl::SHOTLocalReferenceFrameEstimation<pcl::PointXYZ, pcl::ReferenceFrame> estimation;
  estimation.setInputCloud(surface.points);
  estimation.setIndices(rows);
  estimation.setSearchMethod(tree);
  estimation.setRadiusSearch(radius);
  Frames::Ptr frames(new Frames);
  estimation.compute(*frames);
  return frames;
}

/// The descriptors of surface points `rows`, in their order.
pcl::PointCloud<pcl::SHOT352> describe(const PclSurface& surface, const Tree::Ptr& tree,
                                       const pcl::IndicesConstPtr& rows, double radius) {
  pcl::SHOTEstimation<pcl::PointXYZ, pcl::Normal, pcl::SHOT352> estimation;
  estimation.setInputCloud(surface.points);
  estimation.setInputNormals(surface.normals);
  estimation.setIndices(rows);
  estimation.setSearchMethod(tree);
  estimation.setRadiusSearch(radius);
  estimation.setInputReferenceFrames(local_frames(surface, tree, rows, radius));
  pcl::PointCloud<pcl::SHOT352> descriptors;
  estimation.compute(descriptors);
  if (descriptors.size() != rows->size())
    throw std::runtime_error("PCL returned " + std::to_string(descriptors.size()) +
                             " SHOT descriptors for " + std::to_string(rows->size()) + " points");
  return descriptors;
}

FeatureSet describe_shot(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                         const Params& params) {
  require_describable(cloud, points, scale);
  const float radius = static_cast<float>(params.radius) * scale.resolution;
  const PclSurface surface = make_pcl_surface(cloud);
  const Describable chosen = select_describable(surface, PointGrid(cloud.points, radius), points,
                                                radius, params.min_neighbours);
  const Tree::Ptr tree(new Tree(false));
  if (!chosen.row.empty()) tree->setInputCloud(surface.points);
  DescriptorMatrix descriptors(static_cast<Eigen::Index>(points.indices.size()), kLength);
  std::vector<char> described(points.indices.size(), 0);
  const std::size_t chunks = (chosen.row.size() + kChunk - 1) / kChunk;
  graph::parallel_for(chunks, 1, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, chosen.row.size());
    const pcl::IndicesConstPtr rows(
        new pcl::Indices(chosen.row.begin() + static_cast<std::ptrdiff_t>(begin),
                         chosen.row.begin() + static_cast<std::ptrdiff_t>(end)));
    const auto result = describe(surface, tree, rows, radius);
    for (std::size_t i = begin; i < end; ++i) {
      descriptors.row(static_cast<Eigen::Index>(chosen.feature[i])) =
          Eigen::Map<const Eigen::RowVectorXf>(result[i - begin].descriptor, kLength);
      described[chosen.feature[i]] = 1;
    }
  });
  return keep_described(cloud, points, descriptors, described);
}

const auto registered =
    graph::register_node("describe_shot", describe_shot,
                         "SHOT: histograms of normals in a local frame (352 numbers).")
        .input("cloud")
        .input("points")
        .input("scale")
        .output("features")
        .param("radius", &Params::radius, "x resolution", "Neighbours within this are described.",
               graph::greater_than(0))
        .param("min_neighbours", &Params::min_neighbours, "",
               "A feature point with fewer is left out.", graph::at_least(5));

}  // namespace
}  // namespace posevote
