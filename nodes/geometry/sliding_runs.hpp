// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
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
    const double low = static_cast<double>(x) - reach, high = static_cast<double>(x) + reach;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      GridRun& run = runs_[r];
      while (run.begin < rods_[r].end && grid_.x()[run.begin] < low) ++run.begin;
      run.end = std::max(run.end, run.begin);
      while (run.end < rods_[r].end && grid_.x()[run.end] <= high) ++run.end;
    }
  }

  const PointGrid& grid_;
  float radius_;
  std::vector<GridRun> rods_;  ///< around the piece
  std::vector<GridRun> runs_;  ///< of those, around one of its points
};

}  // namespace posevote::geometry
