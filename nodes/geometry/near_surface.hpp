// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "nodes/geometry/grid.hpp"

namespace posevote::geometry {

/// Says of one place after the other whether a cloud's surface is near. What was near the last one
/// is tried first: places that are asked for in a row lie side by side. One for each thread; keeps
/// references.
class NearSurface {
 public:
  /// `grid`: of the cloud's points.
  NearSurface(const Cloud& cloud, const PointGrid& grid) : cloud_(cloud), grid_(grid) {}

  /// Whether agrees(cosine between `normal` and its own) holds for a point within `radius` of
  /// `place` [m]. Most that have one should have it within `probably`.
  template <class Agrees>
  bool is_near(const Eigen::Vector3f& place, const Eigen::Vector3f& normal, float radius,
               float probably, const Agrees& agrees) {
    const auto will_do = [&](std::uint32_t i, float) {
      return agrees(cloud_.normals.row(static_cast<Eigen::Index>(i)).dot(normal));
    };
    if (last_ && squared_distance(*last_, place) <= radius * radius && will_do(*last_, 0))
      return true;
    auto found = grid_.find_within(place, probably, will_do);
    if (!found && probably < radius) found = grid_.find_within(place, radius, will_do);
    if (found) last_ = found;
    return found.has_value();
  }

 private:
  /// Rounded as the grid does: one step of the radius along a face the point that it starts from is
  /// exactly that far.
  float squared_distance(std::uint32_t i, const Eigen::Vector3f& place) const {
    const Eigen::Vector3f off = cloud_.points.row(static_cast<Eigen::Index>(i)).transpose() - place;
    return off.x() * off.x() + off.y() * off.y() + off.z() * off.z();
  }

  const Cloud& cloud_;
  const PointGrid& grid_;
  std::optional<std::uint32_t> last_;  ///< that was found
};

}  // namespace posevote::geometry
