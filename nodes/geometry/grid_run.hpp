// SPDX-License-Identifier: BSD-3-Clause
// How vector kernels see the points of a PointGrid. No header of Eigen here: the kernels are
// compiled for every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace posevote::geometry {

/// Positions begin to end - 1 in the order of a PointGrid.
struct GridRun {
  std::uint32_t begin, end;
};

/// So many floats behind a grid's last coordinate may be read.
constexpr std::size_t kGridPadding = 16;

}  // namespace posevote::geometry
