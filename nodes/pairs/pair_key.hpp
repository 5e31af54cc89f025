// SPDX-License-Identifier: BSD-3-Clause
// The point pair feature of Drost, Ulrich, Navab, Ilic (CVPR 2010, eq. 1) in bins: how far apart two
// oriented points are, and the three angles between their normals and the way from one to the other.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "nodes/pairs/pair_limits.hpp"

namespace posevote::pairs {

inline constexpr int kAngleBins = 15;  ///< of 12 deg, as Drost et al. have them

/// A cosine's number among those that are told apart.
inline std::int32_t angle_step(float cosine) {
  return static_cast<std::int32_t>(
      std::clamp((cosine + 1) * kCosineSteps, 0.0F, 2.0F * kCosineSteps));
}

/// The bins of angles by the angle_step of their cosines, without an arc cosine for each.
inline std::uint32_t angle_bin(std::int32_t step) {
  static const auto bins = [] {
    std::array<std::uint8_t, 2 * kCosineSteps + 1> all{};
    for (int i = 0; i <= 2 * kCosineSteps; ++i)
      all[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
          std::min(std::acos(static_cast<double>(i) / kCosineSteps - 1) * kAngleBins / kPi,
                   kAngleBins - 1.0));
    return all;
  }();
  return bins[static_cast<std::size_t>(step)];
}

/// Of the angle_steps of three angles.
inline std::uint16_t angle_bins(std::int32_t from, std::int32_t to, std::int32_t between) {
  return static_cast<std::uint16_t>((angle_bin(from) * kAngleBins + angle_bin(to)) * kAngleBins +
                                    angle_bin(between));
}

/// The numbers of bins there are for pairs of points up to `reach` apart.
inline std::uint32_t length_bins(float step, float reach) {
  return static_cast<std::uint32_t>(reach / step) + 1;
}
inline std::uint32_t pair_bins(std::uint32_t lengths) {
  return lengths * kAngleBins * kAngleBins * kAngleBins;
}

/// No bin: the two points are less than a step apart, so that their places say nothing, or lie in
/// one plane. Such pairs are by far the most in scans and in models of anything flat, and fit at any
/// place of any plane.
inline constexpr std::uint32_t kNoBin = 0xFFFFFFFF;

/// Angles of no bin.
inline constexpr std::uint16_t kNoAngles = 0xFFFF;

/// The bins of the three angles of the pair from one point with unit normal `from` to another with
/// unit normal `to`, `offset` of this `length` away.
inline std::uint16_t angle_bins(const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                                const Eigen::Vector3f& offset, float length) {
  const float along_from = from.dot(offset) / length;
  const float along_to = to.dot(offset) / length;
  const float between = from.dot(to);
  if (std::abs(along_from) < kInPlane && std::abs(along_to) < kInPlane && between > kSameNormal)
    return kNoAngles;
  return angle_bins(angle_step(along_from), angle_step(along_to), angle_step(between));
}

/// The bin of a pair of these angle_bins, `length` apart [m]; lengths are told in steps [m].
inline std::uint32_t pair_bin(float length, std::uint16_t angles, float step) {
  if (!(length >= step) || angles == kNoAngles) return kNoBin;
  return pair_bins(static_cast<std::uint32_t>(length / step)) + angles;
}

/// The same of the two points.
inline std::uint32_t pair_bin(const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                              const Eigen::Vector3f& offset, float step) {
  const float length = offset.norm();
  return length >= step ? pair_bin(length, angle_bins(from, to, offset, length), step) : kNoBin;
}

}  // namespace posevote::pairs
