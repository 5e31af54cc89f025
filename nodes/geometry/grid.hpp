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
#include "nodes/geometry/grid_run.hpp"

namespace posevote::geometry {

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
    for_each_position_within(center, radius, [&](std::size_t position, float squared) {
      visit(index_[position], squared);
    });
  }

  /// The same, with the positions of the points in the grid's order: for what is kept in that order,
  /// where neighbours lie side by side in memory.
  template <class Visit>
  void for_each_position_within(const Eigen::Vector3f& center, float radius,
                                const Visit& visit) const {
    visit_until(center, radius, [&](std::size_t position, float squared) {
      visit(position, squared);
      return false;
    });
  }

  /// The first of the points within `radius` of `center` for which test(index, squared distance)
  /// holds, in the order of for_each_within; asks no further.
  template <class Test>
  std::optional<std::uint32_t> find_within(const Eigen::Vector3f& center, float radius,
                                           const Test& test) const {
    std::optional<std::uint32_t> found;
    visit_until(center, radius, [&](std::size_t position, float squared) {
      if (!test(index_[position], squared)) return false;
      found = index_[position];
      return true;
    });
    return found;
  }

  /// Sets `runs` to runs of points that hold all those within `radius` of the box from `low` to
  /// `high` (finite), and some others: the way in for kernels that take many points at once.
  void find_runs(const Eigen::Vector3f& low, const Eigen::Vector3f& high, float radius,
                 std::vector<GridRun>& runs) const {
    runs.clear();
    for_each_run(low, high, radius, [&runs](const GridRun& run) { runs.push_back(run); });
  }

  /// The points in the grid's order, those of one rod by x. Behind the last of the coordinates
  /// kGridPadding floats may be read.
  std::size_t size() const { return index_.size(); }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  const std::vector<std::uint32_t>& indices() const { return index_; }  ///< of the cloud, each

  /// Cuts the rods into runs of at most `length` [m] along x; of one point each where it is not >= 0.
  std::vector<GridRun> pieces(float length) const;

 private:
  struct Slot {
    std::uint64_t key = 0;
    GridRun rod{};
  };

  /// Calls is_enough(position, squared distance) for points within `radius`, until it holds.
  template <class IsEnough>
  void visit_until(const Eigen::Vector3f& center, float radius, const IsEnough& is_enough) const {
    if (!center.allFinite() || !(radius >= 0)) return;
    const float squared_radius = radius * radius;
    bool enough = false;
    for_each_run(center, center, radius, [&](const GridRun& run) {
      for (std::size_t i = run.begin; i < run.end && !enough; ++i) {
        const float dx = x_[i] - center.x();
        const float dy = y_[i] - center.y();
        const float dz = z_[i] - center.z();
        const float squared = dx * dx + dy * dy + dz * dz;
        enough = squared <= squared_radius && is_enough(i, squared);
      }
    });
  }

  /// find_runs, one by one.
  template <class Visit>
  void for_each_run(const Eigen::Vector3f& low, const Eigen::Vector3f& high, float radius,
                    const Visit& visit) const {
    if (size() == 0) return;
    // The windows are a trifle wider than the ball: only the distance decides who is in.
    const double reach = 1.000001 * radius;
    const std::int64_t y_begin = row(low.y() - reach, origin_.y());
    const std::int64_t y_end = row(high.y() + reach, origin_.y());
    const std::int64_t z_begin = row(low.z() - reach, origin_.z());
    const std::int64_t z_end = row(high.z() + reach, origin_.z());
    const auto rods =
        static_cast<double>(y_end - y_begin + 1) * static_cast<double>(z_end - z_begin + 1);
    if (rods > static_cast<double>(slots_.size()))  // fewer points than places to look for them
      return visit(GridRun{0, static_cast<std::uint32_t>(size())});
    for (std::int64_t z = z_begin; z <= z_end; ++z)
      for (std::int64_t y = y_begin; y <= y_end; ++y) {
        const GridRun rod = find(y, z);
        const auto end = x_.begin() + rod.end;
        const auto first = std::lower_bound(x_.begin() + rod.begin, end, low.x() - reach);
        const auto last = std::upper_bound(first, end, high.x() + reach);
        if (first != last) visit(GridRun{position(first), position(last)});
      }
  }

  std::uint32_t position(std::vector<float>::const_iterator x) const {
    return static_cast<std::uint32_t>(x - x_.begin());
  }
  /// Clamped to the occupied range: nothing beyond it is worth a visit.
  std::int64_t row(double coordinate, float origin) const {
    const double cell = std::floor((coordinate - origin) / cell_);
    return static_cast<std::int64_t>(std::clamp(cell, -1.0, last_row_ + 1.0));
  }
  GridRun find(std::int64_t y, std::int64_t z) const;
  /// Of a rod, `y` and `z` below rows_: of as few bits as rods can be told by.
  std::uint64_t key_of(std::int64_t y, std::int64_t z) const {
    return static_cast<std::uint64_t>(z) * rows_ + static_cast<std::uint64_t>(y);
  }

  float cell_ = 1;
  double last_row_ = 0;
  std::uint64_t rows_ = 1;
  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  std::vector<float> x_, y_, z_;  ///< padded
  std::vector<std::uint32_t> index_;
  std::vector<Slot> slots_;  ///< open addressing, a power of two; an empty rod marks a free slot
};

}  // namespace posevote::geometry
