// SPDX-License-Identifier: BSD-3-Clause
// Leaves out a scan's feature points on flat ground: of a table or a wall, all descriptors are
// alike, match anything flat, and cost as much time as those that tell something.
//
// A point's relief is how much the normals around it differ: 1 - the largest eigenvalue of the mean
// of n n^T over the oriented points within about `radius`; 0 on a plane, 2/3 at most (Harris' idea,
// on normals). Noise gives a plane some relief, too: the sine of the normals' error, squared. Flat
// sides of objects keep the points near their edges. A scan that is flat everywhere keeps all. Sums
// are taken over cubes of half the radius: O(n log n).
//
//   drop_flat: {in: [cloud, points, scale], out: points, min_relief: 0.03}
#include <algorithm>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/spread.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::prepare {
namespace {

struct Params {
  double min_relief = 0.03;
  double radius = 12;
};

/// Sum of n n^T, and of the points that have a normal.
struct Moments {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double count = 0;
};

std::vector<Moments> moments_of(const Cloud& cloud, const geometry::Voxels& voxels) {
  std::vector<Moments> moments(voxels.size());
  graph::parallel_for(voxels.size(), 256, [&](std::size_t v) {
    for (const std::uint32_t i : voxels[v]) {
      const Eigen::Vector3d normal = cloud.normals.row(i).transpose().cast<double>();
      if (!normal.allFinite() || normal.isZero()) continue;
      moments[v].squares += normal * normal.transpose();
      ++moments[v].count;
    }
  });
  return moments;
}

/// The relief around each point of the cloud: that of its cube and the cubes around.
std::vector<float> relief_around(const Cloud& cloud, float radius) {
  const geometry::Voxels voxels = geometry::group_by_voxel(cloud.points, radius / 2);
  const std::vector<Moments> moments = moments_of(cloud, voxels);
  const PointMatrix centroids = voxels.centroids(cloud.points);
  const geometry::PointGrid grid(centroids, radius);
  std::vector<float> relief(static_cast<std::size_t>(cloud.points.rows()), 0);
  graph::parallel_for(voxels.size(), 64, [&](std::size_t v) {
    Moments sum;
    grid.for_each_within(centroids.row(static_cast<Eigen::Index>(v)), radius,
                         [&](std::uint32_t near, float) {
                           sum.squares += moments[near].squares;
                           sum.count += moments[near].count;
                         });
    const auto here =
        sum.count > 0 ? static_cast<float>(geometry::relief_of(sum.squares / sum.count)) : 0.0F;
    for (const std::uint32_t i : voxels[v]) relief[i] = here;
  });
  return relief;
}

FeaturePoints drop_flat(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                        const Params& params) {
  if (params.min_relief == 0) return points;
  const std::vector<float> relief =
      relief_around(cloud, static_cast<float>(params.radius) * scale.resolution);
  FeaturePoints kept = points;
  std::erase_if(kept.indices,
                [&](std::uint32_t i) { return relief[i] < static_cast<float>(params.min_relief); });
  return kept.indices.empty() ? points : kept;
}

const auto registered =
    graph::register_node("drop_flat", drop_flat, "Leaves out feature points on flat ground.")
        .input("cloud")
        .input("points")
        .input("scale")
        .output("points")
        .param("min_relief", &Params::min_relief, "",
               "Least variation of the normals around a feature point; 0 keeps all.",
               graph::in_range(0, 0.67))
        .param("radius", &Params::radius, "x resolution",
               "The ground around a point whose normals are compared.", graph::greater_than(0));

}  // namespace
}  // namespace posevote::prepare
