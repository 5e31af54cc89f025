// SPDX-License-Identifier: BSD-3-Clause
// A picture with a depth buffer: points are splatted, text is stamped, the result is a PNG.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace posevote {

using Colour = Eigen::Vector3f;  ///< red, green, blue in [0, 1]

class Canvas {
 public:
  Canvas(int width, int height, const Colour& background);

  /// A square of 2 * radius + 1 pixels around (x, y), where nothing nearer has been drawn.
  void splat(float x, float y, float depth, int radius, const Colour& colour);

  /// Letters, digits and . - _ % in 5 x 7 dots, `size` pixels a dot, on a dark plate; clipped.
  void text(int x, int y, int size, const std::string& words, const Colour& colour);

  /// Throws std::runtime_error naming the file if it cannot be written; no half file is left.
  void save(const std::filesystem::path& png) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void fill(int x, int y, int width, int height, const Colour& colour);

  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;  ///< height x width x 3
  std::vector<float> depth_;
};

/// The i-th of a row of colours that are easy to tell apart.
Colour distinct_colour(std::size_t i);

}  // namespace posevote
