// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/color/srgb.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace posevote::color {
namespace {

double decoded(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

float lab_root(float ratio) {
  constexpr float kLinearBelow = 216.0F / 24389.0F;
  return ratio > kLinearBelow ? std::cbrt(ratio) : (24389.0F / 27.0F * ratio + 16.0F) / 116.0F;
}

}  // namespace

float linear_of(std::uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(decoded(static_cast<double>(i) / 255));
    return values;
  }();
  return table[value];
}

float linear_of(double encoded) {
  return encoded > 0 ? static_cast<float>(decoded(std::min(encoded, 1.0))) : 0.0F;
}

std::uint8_t byte_of(float linear) {
  const double light = linear > 0 ? std::min(static_cast<double>(linear), 1.0) : 0;
  const double encoded =
      light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

PointMatrix lab_of(const ColorMatrix& colors) {
  // Rows: X, Y, Z of sRGB's primaries, each over that of white.
  Eigen::Matrix3f to_xyz;
  to_xyz << 0.412391F, 0.357584F, 0.180481F, 0.212639F, 0.715169F, 0.072192F, 0.019331F, 0.119195F,
      0.950532F;
  for (int row = 0; row < 3; ++row) to_xyz.row(row) /= to_xyz.row(row).sum();
  PointMatrix lab(colors.rows(), 3);
  for (Eigen::Index i = 0; i < colors.rows(); ++i) {
    const Eigen::Vector3f xyz = to_xyz * colors.row(i).transpose();
    const float x = lab_root(xyz.x()), y = lab_root(xyz.y()), z = lab_root(xyz.z());
    lab.row(i) << 116 * y - 16, 500 * (x - y), 200 * (y - z);
  }
  return lab;
}

}  // namespace posevote::color
