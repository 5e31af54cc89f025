// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/color_step.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace posevote::pairs {
namespace {

// Units of CIELAB.
constexpr float kLightness = 30;  // a step of it, of four: light that falls on another side
constexpr float kChroma = 12;     // of eight

std::uint8_t level(float change, float step, int levels) {
  const auto at = static_cast<int>(std::floor(change / step + static_cast<float>(levels) / 2));
  return static_cast<std::uint8_t>(std::clamp(at, 0, levels - 1));
}

bool is_like(unsigned one, unsigned other) {
  const auto near = [&](unsigned shift, unsigned mask) {
    const int a = static_cast<int>(one >> shift & mask),
              b = static_cast<int>(other >> shift & mask);
    return std::abs(a - b) <= 1;
  };
  return near(6, 3) && near(3, 7) && near(0, 7);
}

}  // namespace

std::uint8_t color_step(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  const Eigen::Vector3f change = to - from;
  return static_cast<std::uint8_t>(level(change.x(), kLightness, 4) << 6 |
                                   level(change.y(), kChroma, 8) << 3 |
                                   level(change.z(), kChroma, 8));
}

const LikeSteps& like_steps(std::uint8_t step) {
  static const auto all = [] {
    auto table = std::make_unique<std::array<LikeSteps, 256>>();
    for (unsigned a = 0; a < 256; ++a)
      for (unsigned b = 0; b < 256; ++b) (*table)[a][b] = is_like(a, b);
    return table;
  }();
  return (*all)[step];
}

}  // namespace posevote::pairs
