// SPDX-License-Identifier: BSD-3-Clause
// A picture with a depth buffer: discs are drawn, text is stamped, the result is a PNG.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace posevote::pictures {

using Colour = Eigen::Vector3f;  ///< red, green, blue in [0, 1]

/// A small flat disc in space, as the picture sees it.
struct Disc {
  float x = 0, y = 0;                              ///< center [pixel]
  float depth = 0;                                 ///< of the center, any unit
  float radius = 1;                                ///< seen from the front [pixel]
  Eigen::Vector2f tilt = Eigen::Vector2f::Zero();  ///< gain of depth along x and y, per pixel, in
                                                   ///< pixels
  float pixel = 1;                                 ///< size of a pixel at this depth, unit of depth
};

class Canvas {
 public:
  Canvas(int width, int height, const Colour& background);

  /// Draws where nothing nearer has been drawn: at least the disc's center, at most 40 pixels
  /// around. Discs of which center or tilt is not finite, or beyond 1e6 or 1000, are left out.
  void draw(const Disc& disc, const Colour& colour);

  /// Colours the edge of what was drawn on a canvas of the same size, `width` pixels inward.
  void outline(const Canvas& shape, int width, const Colour& colour);

  /// The same picture at half the size, each pixel the mean of four: smooth edges.
  Canvas halved() const;

  /// Letters, digits and . - _ % in 5 x 7 dots, `size` pixels a dot, on a dark plate; clipped.
  void text(int x, int y, int size, const std::string& words, const Colour& colour);

  /// Throws std::runtime_error naming the file if it cannot be written; no half file is left.
  void save(const std::filesystem::path& png) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  std::size_t index(int row, int column) const;
  void fill(int x, int y, int width, int height, const Colour& colour);

  int width_;
  int height_;
  std::vector<std::uint32_t> pixels_;  ///< height x width and kDiscPadding; red in the lowest byte
  std::vector<float> depth_;
};

/// The i-th of a row of colours that are easy to tell apart.
Colour distinct_colour(std::size_t i);

}  // namespace posevote::pictures
