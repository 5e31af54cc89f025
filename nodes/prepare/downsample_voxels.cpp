// SPDX-License-Identifier: BSD-3-Clause
// One oriented point per occupied voxel: the centroid and the mean normal (paper, section 4).
//
// Where a voxel holds both sides of a thin wall, the mean normal would be garbage: points whose
// normal opposes that of the voxel's first point make a second output point. Output in voxel order,
// O(n log n). Fails where points have no normals, or where the cloud is far larger than the voxels.
//
//   downsample_scene: {node: downsample_voxels, in: [oriented_scan, scale], out: cloud, leaf_size:
//   1} downsample_voxels: {in: [cloud, scale], out: small_cloud}
#include <array>
#include <stdexcept>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/prepare/voxels.hpp"

namespace posevote {
namespace {

struct Params {
  double leaf_size = 1;
};

/// Sums over the points of one side.
struct Side {
  Eigen::RowVector3d points = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d normals = Eigen::RowVector3d::Zero();
  int count = 0;
};

std::array<Side, 2> sum_sides(const Cloud& cloud, const Voxels& voxels, std::size_t voxel) {
  std::array<Side, 2> sides;
  const Eigen::RowVector3f first = cloud.normals.row(voxels.order[voxels.starts[voxel]]);
  for (std::size_t i = voxels.starts[voxel]; i < voxels.starts[voxel + 1]; ++i) {
    const std::uint32_t point = voxels.order[i];
    Side& side = sides[cloud.normals.row(point).dot(first) < 0 ? 1 : 0];
    side.points += cloud.points.row(point).cast<double>();
    side.normals += cloud.normals.row(point).cast<double>();
    ++side.count;
  }
  return sides;
}

Cloud downsample_voxels(const Cloud& cloud, const Scale& scale, const Params& params) {
  if (cloud.normals.rows() != cloud.points.rows())
    throw std::runtime_error("its points have no normals: put a normals node before this one");
  const Voxels voxels =
      group_by_voxel(cloud.points, static_cast<float>(params.leaf_size) * scale.resolution);
  Cloud out;
  out.viewpoint = cloud.viewpoint;
  out.dropped = cloud.dropped;
  out.points.resize(static_cast<Eigen::Index>(2 * voxels.size()), 3);
  out.normals.resize(out.points.rows(), 3);
  Eigen::Index count = 0;
  for (std::size_t v = 0; v < voxels.size(); ++v)
    for (const Side& side : sum_sides(cloud, voxels, v)) {
      if (side.count == 0 || !(side.normals.norm() > 0)) continue;
      out.points.row(count) = (side.points / side.count).cast<float>();
      out.normals.row(count++) = side.normals.normalized().cast<float>();
    }
  out.points.conservativeResize(count, 3);
  out.normals.conservativeResize(count, 3);
  return out;
}

const auto registered =
    graph::register_node("downsample_voxels", downsample_voxels,
                         "One oriented point per occupied voxel (centroid, mean normal).")
        .input("cloud")
        .input("scale")
        .output("cloud")
        .param("leaf_size", &Params::leaf_size, "x resolution", "Edge of a voxel.",
               graph::greater_than(0));

}  // namespace
}  // namespace posevote
