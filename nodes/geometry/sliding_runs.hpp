// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "nodes/geometry/grid.hpp"

namespace posevote::geometry {

/// What PointGrid::find_runs finds around each of a grid's own points, where all are asked for: those of a
/// piece of a rod (PointGrid::pieces) share one look for the rods around them, and follow each other
/// along x, so that the runs slide along. One for each thread; keeps references.
class SlidingRuns {
 public:
  /// `radius` [m]: of what is around a point.
  SlidingRuns(const PointGrid& grid, float radius) : grid_(grid), radius_(radius) {}

  /// Calls visit(position, runs) for each point of a piece.
  template <class Visit>
  void for_each(const GridRun& piece, const Visit& visit) {
    Eigen::AlignedBox3f box;
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) box.extend(point(i));
    grid_.find_runs(box.min(), box.max(), radius_, rods_);
    runs_ = rods_;
    for (GridRun& run : runs_) run.end = run.begin;
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
      slide_to(grid_.x()[i]);
      visit(i, runs_);
    }
  }

 private:
  Eigen::Vector3f point(std::uint32_t i) const {
    return {grid_.x()[i], grid_.y()[i], grid_.z()[i]};
  }

  void slide_to(float x) {
    // A trifle wider than the ball, as find_runs.
    const double reach = 1.000001 * radius_;
    const float low = rounded_up(static_cast<double>(x) - reach);
    const float high = -rounded_up(-(static_cast<double>(x) + reach));
    const float* at = grid_.x();
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const std::uint32_t last = rods_[r].end;
      std::uint32_t begin = runs_[r].begin;
      while (begin < last && at[begin] < low) ++begin;
      std::uint32_t end = std::max(runs_[r].end, begin);
      while (end < last && at[end] <= high) ++end;
      runs_[r] = {begin, end};
    }
  }

  /// The least float that is not below: others compare with it as with the value itself.
  static float rounded_up(double value) {
    const auto rounded = static_cast<float>(value);
    if (static_cast<double>(rounded) >= value) return rounded;
    return std::nextafter(rounded, std::numeric_limits<float>::infinity());
  }

  const PointGrid& grid_;
  float radius_;
  std::vector<GridRun> rods_;  ///< around the piece
  std::vector<GridRun> runs_;  ///< of those, around one of its points
};

}  // namespace posevote::geometry
