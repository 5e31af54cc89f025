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
#include <limits>
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
    for_each_offset_within(center, radius,
                           [&visit](std::uint32_t index, float squared, float, float, float) {
                             visit(index, squared);
                           });
  }

  /// The same, calling visit(index, squared distance, dx, dy, dz): the offset from `center`.
  template <class Visit>
  void for_each_offset_within(const Eigen::Vector3f& center, float radius,
                              const Visit& visit) const {
    if (x_.empty() || !center.allFinite() || !(radius >= 0)) return;
    // The windows are a trifle wider than the ball: only the distance decides who is in.
    const double reach = 1.000001 * radius;
    const std::int64_t y_begin = row(center.y() - reach, origin_.y());
    const std::int64_t y_end = row(center.y() + reach, origin_.y());
    const std::int64_t z_begin = row(center.z() - reach, origin_.z());
    const std::int64_t z_end = row(center.z() + reach, origin_.z());
    const auto rods =
        static_cast<double>(y_end - y_begin + 1) * static_cast<double>(z_end - z_begin + 1);
    if (rods > static_cast<double>(slots_.size()))  // fewer points than places to look for them
      return visit_rod({0, static_cast<std::uint32_t>(x_.size())}, kNoEnd, center, radius, visit);
    for (std::int64_t z = z_begin; z <= z_end; ++z)
      for (std::int64_t y = y_begin; y <= y_end; ++y) {
        const Rod rod = find(y, z);
        const auto first =
            std::lower_bound(x_.begin() + rod.begin, x_.begin() + rod.end, center.x() - reach);
        const Rod from{static_cast<std::uint32_t>(first - x_.begin()), rod.end};
        visit_rod(from, center.x() + reach, center, radius, visit);
      }
  }

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

  static constexpr double kNoEnd = std::numeric_limits<double>::infinity();

  /// Visits the points of a stretch of a rod up to `x_end` that lie in the ball.
  template <class Visit>
  void visit_rod(const Rod& rod, double x_end, const Eigen::Vector3f& center, float radius,
                 const Visit& visit) const {
    const float squared_radius = radius * radius;
    for (std::size_t i = rod.begin; i < rod.end && x_[i] <= x_end; ++i) {
      const float dx = x_[i] - center.x();
      const float dy = y_[i] - center.y();
      const float dz = z_[i] - center.z();
      const float squared = dx * dx + dy * dy + dz * dz;
      if (squared <= squared_radius) visit(index_[i], squared, dx, dy, dz);
    }
  }

  /// Clamped to the occupied range: nothing beyond it is worth a visit.
  std::int64_t row(double coordinate, float origin) const {
    const double cell = std::floor((coordinate - origin) / cell_);
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
