// SPDX-License-Identifier: BSD-3-Clause
// Fixed-radius and nearest-neighbour search over points: the one spatial index of normals,
// descriptors, ICP and segmentation.
//
// Points are sorted into square rods along x, `cell` wide in y and z, and by x within a rod. A
// search of radius r visits the few rods within r and, by bisection, only their stretch [x - r, x +
// r]. Only occupied rods are stored, in a hash table, so far outliers cost nothing. Memory: 20
// bytes a point.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// A point near a query.
struct Neighbour {
  std::uint32_t index = 0;
  float squared = 0;  ///< squared distance [m^2]
};

/// Immutable once built; safe to read from many threads. Points that are not finite are never
/// found.
class PointGrid {
 public:
  /// `cell`: width of a rod [m]; searches are fastest with a radius of one to two cells.
  PointGrid(const PointMatrix& points, float cell);

  /// Calls visit(index, squared distance) for every point within `radius` of `center`, in an order
  /// that depends on the points and the query alone.
  template <class Visit>
  void for_each_within(const Eigen::Vector3f& center, float radius, const Visit& visit) const {
    if (x_.empty() || !center.allFinite() || !(radius >= 0)) return;
    const float squared_radius = radius * radius;
    const std::int64_t y_end = row(center.y() + radius, origin_.y());
    const std::int64_t z_end = row(center.z() + radius, origin_.z());
    for (std::int64_t z = row(center.z() - radius, origin_.z()); z <= z_end; ++z)
      for (std::int64_t y = row(center.y() - radius, origin_.y()); y <= y_end; ++y) {
        const Rod rod = find(y, z);
        const auto begin = x_.begin() + rod.begin;
        auto i = static_cast<std::size_t>(
            std::lower_bound(begin, x_.begin() + rod.end, center.x() - radius) - x_.begin());
        for (; i < rod.end && x_[i] <= center.x() + radius; ++i) {
          const float dx = x_[i] - center.x();
          const float dy = y_[i] - center.y();
          const float dz = z_[i] - center.z();
          const float squared = dx * dx + dy * dy + dz * dz;
          if (squared <= squared_radius) visit(index_[i], squared);
        }
      }
  }

  float cell() const { return cell_; }

  /// The nearest point within `radius`; of several at one distance the one with the smallest index.
  std::optional<Neighbour> nearest(const Eigen::Vector3f& center, float radius) const;

 private:
  struct Rod {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  struct Slot {
    std::uint64_t key = 0;
    Rod rod;
  };

  /// Clamped to the occupied range: nothing beyond it is worth a visit.
  std::int64_t row(float coordinate, float origin) const {
    const double cell = std::floor((static_cast<double>(coordinate) - origin) / cell_);
    return static_cast<std::int64_t>(std::clamp(cell, -1.0, last_row_ + 1.0));
  }
  Rod find(std::int64_t y, std::int64_t z) const;

  float cell_ = 1;
  double last_row_ = 0;
  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  std::vector<float> x_, y_, z_;
  std::vector<std::uint32_t> index_;
  std::vector<Slot> slots_;  ///< open addressing, a power of two; an empty rod marks a free slot
};

}  // namespace posevote
