// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/curve_order.hpp"

#include <algorithm>

#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/radix_sort.hpp"

namespace posevote::geometry {
namespace {

constexpr int kBits = 21;  // for each axis

/// Two zeros behind each of the lowest kBits bits.
std::uint64_t spread_out(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x001F00000000FFFFU;
  bits = (bits | bits << 16U) & 0x001F0000FF0000FFU;
  bits = (bits | bits << 8U) & 0x100F00F00F00F00FU;
  bits = (bits | bits << 4U) & 0x10C30C30C30C30C3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

struct Place {
  std::uint64_t along_curve;
  std::uint32_t row;
};

}  // namespace

std::vector<std::uint32_t> rows_along_curve(const PointMatrix& points, float edge) {
  std::vector<std::uint32_t> rows = finite_rows(points);
  if (rows.empty()) return rows;
  const Eigen::AlignedBox3f box = box_around(points, rows);
  constexpr double kMost = (1 << kBits) - 1;
  const double cube =
      std::max(static_cast<double>(edge), static_cast<double>(box.sizes().maxCoeff()) / kMost);
  std::vector<Place> places(rows.size());
  graph::parallel_for(rows.size(), 8192, [&](std::size_t i) {
    const Eigen::Array3d at =
        (points.row(rows[i]).transpose() - box.min()).cast<double>().array() / cube;
    std::uint64_t along = 0;
    for (int axis = 0; axis < 3; ++axis)
      along |= spread_out(static_cast<std::uint64_t>(at[axis])) << axis;
    places[i] = {along, rows[i]};
  });
  radix_sort(places, [](const Place& place) { return place.along_curve; });
  std::ranges::transform(places, rows.begin(), &Place::row);
  return rows;
}

}  // namespace posevote::geometry
