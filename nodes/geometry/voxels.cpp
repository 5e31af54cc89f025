// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/voxels.hpp"

#include <sstream>
#include <stdexcept>

#include "graph/parallel.hpp"
#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/radix_sort.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::geometry {
namespace {

[[noreturn]] void throw_too_large(double extent, double leaf) {
  std::ostringstream text;
  text << "the cloud spans " << extent << " m, too much for voxels of " << leaf
       << " m: wrong unit, or points far away?";
  throw std::runtime_error(text.str());
}

struct Extent {
  Eigen::Array3d low, high;

  double largest() const { return (high - low).maxCoeff(); }
};

Extent extent_of(const PointMatrix& points, const std::vector<std::uint32_t>& rows) {
  const Eigen::AlignedBox3f box = box_around(points, rows);
  return {box.min().cast<double>(), box.max().cast<double>()};
}

/// A point and the number of its voxel, which counts along x, then y, then z.
template <class Number>
struct Member {
  Number voxel;
  std::uint32_t index;
};

template <class Number>
Voxels grouped(const PointMatrix& points, const std::vector<std::uint32_t>& rows,
               const Extent& extent, const Eigen::Array3d& counts, double per_leaf) {
  const auto columns = static_cast<Number>(counts.x()), lines = static_cast<Number>(counts.y());
  std::vector<Member<Number>> members(rows.size());
  graph::parallel_for(rows.size(), 8192, [&](std::size_t i) {
    const Eigen::Array3d point = points.row(rows[i]).transpose().cast<double>();
    const Eigen::Array3d cell = (point - extent.low) * per_leaf;
    members[i] = {
        (static_cast<Number>(cell.z()) * lines + static_cast<Number>(cell.y())) * columns +
            static_cast<Number>(cell.x()),
        rows[i]};
  });
  radix_sort(members, [](const Member<Number>& one) { return one.voxel; });
  Voxels voxels;
  voxels.order.resize(members.size());
  voxels.starts = joined_ranges(members.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> starts;
    for (std::size_t i = begin; i < end; ++i) {
      if (i == 0 || members[i].voxel != members[i - 1].voxel) starts.push_back(i);
      voxels.order[i] = members[i].index;
    }
    return starts;
  });
  voxels.starts.push_back(members.size());
  return voxels;
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
  graph::parallel_for(size(), 2048, [&](std::size_t v) {
    centroids.row(static_cast<Eigen::Index>(v)) = centroid(points, v).cast<float>();
  });
  return centroids;
}

Voxels group_by_voxel(const PointMatrix& points, const std::vector<std::uint32_t>& rows,
                      float leaf) {
  if (rows.empty()) return {{}, {0}};
  const double per_leaf = 1 / static_cast<double>(leaf);
  const Extent extent = extent_of(points, rows);
  const Eigen::Array3d counts = ((extent.high - extent.low) * per_leaf).floor() + 1;
  if (!(counts.maxCoeff() < 4e9)) throw_too_large(extent.largest(), static_cast<double>(leaf));
  // The members of a large scan are most of the memory that it takes here.
  if (counts.prod() < 4e9) return grouped<std::uint32_t>(points, rows, extent, counts, per_leaf);
  if (counts.prod() < 1e19) return grouped<std::uint64_t>(points, rows, extent, counts, per_leaf);
  return grouped<LargeNumber>(points, rows, extent, counts, per_leaf);
}

Voxels group_by_voxel(const PointMatrix& points, float leaf) {
  return group_by_voxel(points, finite_rows(points), leaf);
}

}  // namespace posevote::geometry
