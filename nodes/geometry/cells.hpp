// SPDX-License-Identifier: BSD-3-Clause
// What the indices that sort points into cells share.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::geometry {

inline std::vector<std::uint32_t> finite_rows(const PointMatrix& points) {
  return rows_that(static_cast<std::size_t>(points.rows()),
                   [&](std::uint32_t i) { return points.row(i).allFinite(); });
}

/// Where to look for a key first in a table of mask + 1 slots, a power of two.
inline std::size_t scatter(std::uint64_t key, std::size_t mask) {
  key ^= key >> 32;              // all of it counts in the lower half of the product
  key *= 0x9E3779B97F4A7C15ULL;  // Fibonacci hashing
  return static_cast<std::size_t>(key >> 32) & mask;
}

}  // namespace posevote::geometry
