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

std::size_t ColorShares::bin_of(const Eigen::Vector3f& lab) {
  constexpr float kMiddle = kChromaStep * kChromas / 2;
  const int bin = (bin_along(lab[0], kLightStep, kLights) * kChromas +
                   bin_along(lab[1] + kMiddle, kChromaStep, kChromas)) *
                      kChromas +
                  bin_along(lab[2] + kMiddle, kChromaStep, kChromas);
  return static_cast<std::size_t>(bin);
}

ColorShares::ColorShares(const PointMatrix& lab) {
  std::array<float, static_cast<std::size_t>(kLights * kChromas * kChromas)> counts{};
  for (Eigen::Index i = 0; i < lab.rows(); ++i) ++counts[bin_of(lab.row(i).transpose())];
  // With the bins beside it.
  const auto at = [](int l, int a, int b) {
    return static_cast<std::size_t>((l * kChromas + a) * kChromas + b);
  };
  for (int l = 0; l < kLights; ++l)
    for (int a = 0; a < kChromas; ++a)
      for (int b = 0; b < kChromas; ++b) {
        float sum = 0;
        for (int dl = std::max(0, l - 1); dl <= std::min(kLights - 1, l + 1); ++dl)
          for (int da = std::max(0, a - 1); da <= std::min(kChromas - 1, a + 1); ++da)
            for (int db = std::max(0, b - 1); db <= std::min(kChromas - 1, b + 1); ++db)
              sum += counts[at(dl, da, db)];
        shares_[at(l, a, b)] = sum / static_cast<float>(std::max<Eigen::Index>(1, lab.rows()));
      }
}

}  // namespace posevote::color
