// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "nodes/pairs/pair_limits.hpp"

namespace posevote::pairs {

/// An oriented point and two directions across its normal, in which turns about it are told.
struct LocalFrame {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;  ///< unit
  Eigen::Vector3f u, v;    ///< u x v = normal

  LocalFrame(const Eigen::Vector3f& at, const Eigen::Vector3f& unit_normal)
      : LocalFrame(at, unit_normal, unit_normal.unitOrthogonal()) {}

  /// `unit_u` is perpendicular to the normal.
  LocalFrame(const Eigen::Vector3f& at, const Eigen::Vector3f& unit_normal,
             const Eigen::Vector3f& unit_u)
      : point(at), normal(unit_normal), u(unit_u), v(normal.cross(u)) {}

  /// The turn from u to an offset seen along the normal, in 256ths of a full turn; of an offset along
  /// the normal any.
  std::uint8_t turn_to(const Eigen::Vector3f& offset) const {
    return turn_of(u.dot(offset), v.dot(offset));
  }

  /// atan2(y, x) in 256ths of a full turn, rounded down: five times as fast as the library's.
  static std::uint8_t turn_of(float x, float y) {
    const float wide = std::max(std::abs(x), std::abs(y));
    const float ratio = wide > 0 ? std::min(std::abs(x), std::abs(y)) / wide : 0;
    const float s = ratio * ratio;
    float angle = ((kTurnSeries[2] * s + kTurnSeries[1]) * s - kTurnSeries[0]) * s * ratio + ratio;
    if (std::abs(y) > std::abs(x)) angle = static_cast<float>(kPi / 2) - angle;
    if (x < 0) angle = static_cast<float>(kPi) - angle;
    if (y < 0) angle = static_cast<float>(2 * kPi) - angle;
    return static_cast<std::uint8_t>(static_cast<int>(angle * static_cast<float>(128 / kPi)));
  }

  /// Columns u, v, normal.
  Eigen::Matrix3f axes() const {
    Eigen::Matrix3f columns;
    columns << u, v, normal;
    return columns;
  }
};

}  // namespace posevote::pairs
