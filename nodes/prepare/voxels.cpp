// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/voxels.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace posevote {

Voxels group_by_voxel(const PointMatrix& points, float leaf) {
  constexpr double kMostVoxels = (1 << 21) - 1;
  Voxels voxels;
  if (points.rows() > 0) {
    const Eigen::RowVector3d low = points.colwise().minCoeff().cast<double>();
    const double extent = (points.colwise().maxCoeff().cast<double>() - low).maxCoeff();
    if (!(extent / leaf < kMostVoxels))
      throw std::runtime_error("the cloud spans " + std::to_string(extent) +
                               " m, too much for voxels of " + std::to_string(leaf) +
                               " m: wrong unit, or points far away?");
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(
        static_cast<std::size_t>(points.rows()));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const Eigen::RowVector3d cell =
          (points.row(static_cast<Eigen::Index>(i)).cast<double>() - low) / leaf;
      const auto x = static_cast<std::uint64_t>(cell.x());
      const auto y = static_cast<std::uint64_t>(cell.y());
      const auto z = static_cast<std::uint64_t>(cell.z());
      keys[i] = {(z << 42) | (y << 21) | x, static_cast<std::uint32_t>(i)};
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i == 0 || keys[i].first != keys[i - 1].first) voxels.starts.push_back(i);
      voxels.order.push_back(keys[i].second);
    }
  }
  voxels.starts.push_back(voxels.order.size());
  return voxels;
}

}  // namespace posevote
