// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::geometry {

/// The box around place_of(0) to place_of(count - 1), each an Eigen::Vector3f; parallel.
template <class PlaceOf>
Eigen::AlignedBox3f box_around(std::size_t count, const PlaceOf& place_of) {
  const auto parts = joined_ranges(count, [&](std::size_t begin, std::size_t end) {
    Eigen::AlignedBox3f box;
    for (std::size_t i = begin; i < end; ++i) box.extend(place_of(i));
    return std::vector{box};
  });
  Eigen::AlignedBox3f box;
  for (const Eigen::AlignedBox3f& part : parts) box.extend(part);
  return box;
}

/// The box around those rows.
inline Eigen::AlignedBox3f box_around(const PointMatrix& points,
                                      const std::vector<std::uint32_t>& rows) {
  return box_around(rows.size(), [&](std::size_t i) -> Eigen::Vector3f {
    return points.row(rows[i]).transpose();
  });
}

}  // namespace posevote::geometry
