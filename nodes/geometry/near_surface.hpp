// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/nearest_index.hpp"

namespace posevote::geometry {

/// A model's points, to ask for those near a place. Safe to read from many threads.
struct SurfaceIndex {
  /// `radius`: that is asked for most [m].
  SurfaceIndex(const PointMatrix& points, float radius)
      : grid(points, radius), nearest(points, radius) {}

  PointGrid grid;        ///< for all of them
  NearestIndex nearest;  ///< for one
};

/// Says of one place after the other whether a cloud's surface is near. What was near the last one
/// is tried first: places that are asked for in a row lie side by side. One for each thread; keeps
/// references.
class NearSurface {
 public:
  /// `index`: of the cloud's points.
  NearSurface(const Cloud& cloud, const SurfaceIndex& index) : cloud_(cloud), index_(index) {}

  /// Whether agrees(cosine between `normal` and its own) holds for a point within `radius` of
  /// `place` [m]. It should hold for most that are the nearest.
  template <class Agrees>
  bool is_near(const Eigen::Vector3f& place, const Eigen::Vector3f& normal, float radius,
               const Agrees& agrees) {
    const auto will_do = [&](std::uint32_t i, float) {
      return agrees(cloud_.normals.row(static_cast<Eigen::Index>(i)).dot(normal));
    };
    if (last_ && squared_distance(*last_, place) <= radius * radius && will_do(*last_, 0))
      return true;
    const NearestPoint nearest = index_.nearest.nearest(place, radius);
    if (!nearest) return false;
    const auto found = will_do(nearest.index, 0) ? std::optional(nearest.index)
                                                 : index_.grid.find_within(place, radius, will_do);
    if (found) last_ = found;
    return found.has_value();
  }

 private:
  /// Rounded as the indices do: one step of the radius along a face the point that it starts from is
  /// exactly that far.
  float squared_distance(std::uint32_t i, const Eigen::Vector3f& place) const {
    const Eigen::Vector3f off = cloud_.points.row(static_cast<Eigen::Index>(i)).transpose() - place;
    return off.x() * off.x() + off.y() * off.y() + off.z() * off.z();
  }

  const Cloud& cloud_;
  const SurfaceIndex& index_;
  std::optional<std::uint32_t> last_;  ///< that was found
};

}  // namespace posevote::geometry
