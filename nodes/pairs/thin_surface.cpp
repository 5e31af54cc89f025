// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/thin_surface.hpp"

#include <span>
#include <vector>

#include "nodes/geometry/cloud_of.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::pairs {
namespace {

constexpr float kSameSide = 0.87F;  // cosine of 30 deg
constexpr float kLeastShare = 0.15F;

/// Points of one cube whose normals agree with the first one's.
struct Side {
  Eigen::RowVector3f first;
  Eigen::RowVector3f points = Eigen::RowVector3f::Zero();
  Eigen::RowVector3f normals = Eigen::RowVector3f::Zero();
  Eigen::RowVector3f colors = Eigen::RowVector3f::Zero();
  float count = 0;
};

void add(std::vector<Side>& sides, const Cloud& cloud, std::uint32_t i) {
  const Eigen::RowVector3f normal = cloud.normals.row(i);
  Side* found = nullptr;
  for (Side& side : sides)
    if (side.first.dot(normal) > kSameSide) {
      found = &side;
      break;
    }
  if (!found) found = &sides.emplace_back(Side{normal});
  found->points += cloud.points.row(i);
  found->normals += normal;
  if (cloud.colors.rows() > 0) found->colors += cloud.colors.row(i);
  ++found->count;
}

}  // namespace

Cloud thin_surface(const Cloud& cloud, float edge) {
  if (cloud.points.rows() == 0) return {};
  const geometry::Voxels voxels = geometry::group_by_voxel(
      cloud.points, geometry::oriented_rows(cloud.points, cloud.normals), edge);
  std::vector<Eigen::RowVector3f> points, normals, colors;
  std::vector<Side> sides;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const std::span<const std::uint32_t> members = voxels[v];
    sides.clear();
    for (const std::uint32_t i : members) add(sides, cloud, i);
    for (const Side& side : sides) {
      if (side.count < kLeastShare * static_cast<float>(members.size())) continue;
      points.push_back(side.points / side.count);
      normals.push_back(side.normals.normalized());
      if (cloud.colors.rows() > 0) colors.push_back(side.colors / side.count);
    }
  }
  return geometry::cloud_of(points, normals, colors);
}

}  // namespace posevote::pairs
