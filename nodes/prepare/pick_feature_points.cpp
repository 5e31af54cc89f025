// SPDX-License-Identifier: BSD-3-Clause
// A uniform subset of a cloud: the points that get a descriptor (paper, section 4: some 10 000 a
// model).
//
// Picks the point of each cube of edge `spacing` that is nearest to the centroid of the cube's points. If that
// gives more than `max_points`, the spacing grows until they fit. O(n log n).
//
//   pick_feature_points: {in: [cloud, scale], out: points, spacing: 2.5, max_points: 10000}
#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::prepare {
namespace {

struct Params {
  double spacing = 2.5;
  int max_points = 10000;
};

std::uint32_t most_central(const PointMatrix& points, const geometry::Voxels& voxels,
                           std::size_t voxel) {
  const Eigen::RowVector3d centroid = voxels.centroid(points, voxel);
  const std::span<const std::uint32_t> members = voxels[voxel];
  // The one of two equally central points with smaller coordinates goes first, wherever it stands
  // in the input.
  const auto rank = [&](std::uint32_t i) {
    const double distance = (points.row(i).cast<double>() - centroid).squaredNorm();
    return std::tuple(distance, points(i, 0), points(i, 1), points(i, 2));
  };
  return *std::min_element(members.begin(), members.end(),
                           [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
}

FeaturePoints pick_feature_points(const Cloud& cloud, const Scale& scale, const Params& params) {
  double leaf = params.spacing * scale.resolution;
  geometry::Voxels voxels = geometry::group_by_voxel(cloud.points, static_cast<float>(leaf));
  const auto most = static_cast<std::size_t>(params.max_points);
  while (params.max_points > 0 && voxels.size() > most) {
    // A surface has a number of cubes that falls with the square of their edge.
    leaf *= 1.01 * std::sqrt(static_cast<double>(voxels.size()) / static_cast<double>(most));
    voxels = geometry::group_by_voxel(cloud.points, static_cast<float>(leaf));
  }
  FeaturePoints picked;
  for (std::size_t v = 0; v < voxels.size(); ++v)
    picked.indices.push_back(most_central(cloud.points, voxels, v));
  return picked;
}

const auto registered =
    graph::register_node("pick_feature_points", pick_feature_points,
                         "A uniform subset of a cloud: the points that get a descriptor.")
        .input("cloud")
        .input("scale")
        .output("points")
        .param("spacing", &Params::spacing, "x resolution", "Distance between feature points.",
               graph::greater_than(0))
        .param("max_points", &Params::max_points, "",
               "More points than this widen the spacing; 0: no limit.", graph::at_least(0));

}  // namespace
}  // namespace posevote::prepare
