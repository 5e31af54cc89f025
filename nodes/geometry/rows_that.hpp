// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"

namespace posevote::geometry {

/// What make(begin, end) returns of the ranges that [0, count) falls into, a vector each, one behind
/// the other in their order. `grain`: how long ranges are at least.
template <class Make>
auto joined_ranges(std::size_t count, const Make& make, std::size_t grain = 8192) {
  const std::size_t pieces = count / grain + 1;
  std::vector<decltype(make(count, count))> parts(pieces);
  graph::parallel_for(pieces, 1, [&](std::size_t p) {
    parts[p] = make(p * count / pieces, (p + 1) * count / pieces);
  });
  if (pieces == 1) return std::move(parts.front());
  std::size_t size = 0;
  std::vector<std::size_t> begins;
  for (const auto& part : parts) begins.push_back(std::exchange(size, size + part.size()));
  decltype(make(count, count)) all(size);
  graph::parallel_for(pieces, 1, [&](std::size_t p) {
    std::ranges::move(parts[p], all.begin() + static_cast<std::ptrdiff_t>(begins[p]));
  });
  return all;
}

/// The numbers below `count` that have a property, in ascending order. `grain` as above.
template <class Property>
std::vector<std::uint32_t> rows_that(std::size_t count, const Property& has,
                                     std::size_t grain = 8192) {
  const auto of_range = [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> rows;
    for (std::size_t i = begin; i < end; ++i)
      if (has(static_cast<std::uint32_t>(i))) rows.push_back(static_cast<std::uint32_t>(i));
    return rows;
  };
  return joined_ranges(count, of_range, grain);
}

}  // namespace posevote::geometry
