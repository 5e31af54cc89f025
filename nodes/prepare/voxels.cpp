// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/voxels.hpp"

#include <limits>
#include <sstream>
#include <stdexcept>

#include "nodes/prepare/radix_sort.hpp"

namespace posevote {
namespace {

struct Keyed {
  std::uint32_t z, y, x;
  std::uint32_t index;

  bool same_voxel(const Keyed& other) const { return x == other.x && y == other.y && z == other.z; }
};

[[noreturn]] void throw_too_large(double extent, double leaf) {
  std::ostringstream text;
  text << "the cloud spans " << extent << " m, too much for voxels of " << leaf
       << " m: wrong unit, or points far away?";
  throw std::runtime_error(text.str());
}

std::vector<Keyed> keyed_points(const PointMatrix& points, double leaf) {
  std::vector<Keyed> keyed;
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (!points.row(i).allFinite()) continue;
    const Eigen::Array3d point = points.row(i).transpose().cast<double>();
    low = low.min(point);
    high = high.max(point);
    keyed.push_back({0, 0, 0, static_cast<std::uint32_t>(i)});
  }
  if (keyed.empty()) return keyed;
  const double extent = (high - low).maxCoeff();
  if (!(extent / leaf < 4e9)) throw_too_large(extent, leaf);
  for (Keyed& entry : keyed) {
    const Eigen::Array3d point = points.row(entry.index).transpose().cast<double>();
    const Eigen::Array3d cell = (point - low) / leaf;
    entry.x = static_cast<std::uint32_t>(cell.x());
    entry.y = static_cast<std::uint32_t>(cell.y());
    entry.z = static_cast<std::uint32_t>(cell.z());
  }
  return keyed;
}

}  // namespace

Eigen::RowVector3d Voxels::centroid(const PointMatrix& points, std::size_t voxel) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  const std::span<const std::uint32_t> members = (*this)[voxel];
  for (const std::uint32_t i : members) sum += points.row(i).cast<double>();
  return sum / static_cast<double>(members.size());
}

PointMatrix Voxels::centroids(const PointMatrix& points) const {
  PointMatrix centroids(static_cast<Eigen::Index>(size()), 3);
  for (std::size_t v = 0; v < size(); ++v)
    centroids.row(static_cast<Eigen::Index>(v)) = centroid(points, v).cast<float>();
  return centroids;
}

Voxels group_by_voxel(const PointMatrix& points, float leaf) {
  std::vector<Keyed> keyed = keyed_points(points, leaf);
  radix_sort(keyed, [](const Keyed& one) { return one.x; });
  radix_sort(keyed, [](const Keyed& one) { return one.y; });
  radix_sort(keyed, [](const Keyed& one) { return one.z; });
  Voxels voxels;
  voxels.order.reserve(keyed.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || !keyed[i].same_voxel(keyed[i - 1])) voxels.starts.push_back(i);
    voxels.order.push_back(keyed[i].index);
  }
  voxels.starts.push_back(voxels.order.size());
  return voxels;
}

}  // namespace posevote
