// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

namespace posevote::geometry {

std::vector<std::uint32_t> weld(const PointMatrix& points) {
  const auto place = [&points](std::uint32_t i) {
    std::array<std::uint32_t, 3> bits;
    for (int axis = 0; axis < 3; ++axis)
      bits[static_cast<std::size_t>(axis)] = std::bit_cast<std::uint32_t>(points(i, axis) + 0.0F);
    return bits;  // + 0: minus zero is zero; and bits, unlike floats with NaN among them, sort
  };
  std::vector<std::uint32_t> sorted(static_cast<std::size_t>(points.rows()));
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(place(a), a) < std::pair(place(b), b);
  });
  std::vector<std::uint32_t> first(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    first[sorted[i]] =
        i > 0 && place(sorted[i]) == place(sorted[i - 1]) ? first[sorted[i - 1]] : sorted[i];
  return first;
}

}  // namespace posevote::geometry
