// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/oriented_columns.hpp"

namespace posevote::geometry {

/// A cloud's normals in its grid's order, padded as the grid's coordinates are. Those of which
/// is_usable(row) is false are not numbers.
template <class IsUsable>
PointMatrix in_order_of(const PointGrid& grid, const PointMatrix& normals,
                        const IsUsable& is_usable) {
  const auto count = static_cast<Eigen::Index>(grid.size() + kGridPadding);
  PointMatrix ordered = PointMatrix::Zero(count, 3);
  graph::parallel_for(grid.size(), 4096, [&](std::size_t position) {
    const auto row = static_cast<Eigen::Index>(position);
    const std::uint32_t point = grid.indices()[position];
    ordered.row(row) = normals.row(point);
    if (!is_usable(point)) ordered.row(row).setConstant(std::nanf(""));
  });
  return ordered;
}

/// `normals`: in_order_of the grid.
inline OrientedColumns columns_of(const PointGrid& grid, const PointMatrix& normals) {
  return {grid.x(),
          grid.y(),
          grid.z(),
          normals.col(0).data(),
          normals.col(1).data(),
          normals.col(2).data()};
}

/// The normals of a cloud in the order of its grid, as vector kernels want them. Refers to the grid.
class GridNormals {
 public:
  /// Those of which is_usable(row) is false are not numbers.
  template <class IsUsable>
  GridNormals(const PointGrid& grid, const PointMatrix& normals, const IsUsable& is_usable)
      : grid_(grid), normals_(in_order_of(grid, normals, is_usable)) {}

  OrientedColumns columns() const { return columns_of(grid_, normals_); }

 private:
  const PointGrid& grid_;
  PointMatrix normals_;
};

}  // namespace posevote::geometry
