// SPDX-License-Identifier: BSD-3-Clause
// How much of a surface is of about a colour.
#pragma once

#include <array>
#include <cstddef>

#include "nodes/data/cloud.hpp"

namespace posevote::color {

/// A histogram over CIELAB, so coarse that light and camera change little of it.
class ColorShares {
 public:
  /// Of nothing.
  ColorShares() = default;
  /// `lab`: n x 3, of points that stand for as much surface each.
  explicit ColorShares(const PointMatrix& lab);
  /// In [0, 1], of colours like this one.
  float like(const Eigen::Vector3f& lab) const { return shares_[number_of(bin_of(lab))]; }

 private:
  static constexpr int kLights = 5, kChromas = 16;
  using Bin = std::array<int, 3>;  ///< along L*, a*, b*
  static Bin bin_of(const Eigen::Vector3f& lab);
  static std::size_t number_of(const Bin& bin);

  std::array<float, std::size_t{kLights} * kChromas * kChromas> shares_{};
};

}  // namespace posevote::color
