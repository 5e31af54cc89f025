// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/color/color_shares.hpp"

#include <algorithm>

namespace posevote::color {
namespace {

constexpr float kLightStep = 20, kChromaStep = 10;  // units of CIELAB

int bin_along(float value, float step, int bins) {
  return std::clamp(static_cast<int>(value / step), 0, bins - 1);
}

}  // namespace

ColorShares::Bin ColorShares::bin_of(const Eigen::Vector3f& lab) {
  constexpr float kMiddle = kChromaStep * kChromas / 2;
  return {bin_along(lab[0], kLightStep, kLights),
          bin_along(lab[1] + kMiddle, kChromaStep, kChromas),
          bin_along(lab[2] + kMiddle, kChromaStep, kChromas)};
}

std::size_t ColorShares::number_of(const Bin& bin) {
  return static_cast<std::size_t>((bin[0] * kChromas + bin[1]) * kChromas + bin[2]);
}

ColorShares::ColorShares(const PointMatrix& lab) {
  for (Eigen::Index i = 0; i < lab.rows(); ++i) {
    // In its bin and in those beside it.
    const auto [l, a, b] = bin_of(lab.row(i).transpose());
    for (int near_l = std::max(0, l - 1); near_l <= std::min(kLights - 1, l + 1); ++near_l)
      for (int near_a = std::max(0, a - 1); near_a <= std::min(kChromas - 1, a + 1); ++near_a)
        for (int near_b = std::max(0, b - 1); near_b <= std::min(kChromas - 1, b + 1); ++near_b)
          ++shares_[number_of({near_l, near_a, near_b})];
  }
  for (float& share : shares_) share /= static_cast<float>(std::max<Eigen::Index>(1, lab.rows()));
}

}  // namespace posevote::color
