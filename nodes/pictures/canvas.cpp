// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pictures/canvas.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>

#include "nodes/formats/write_png.hpp"
#include "nodes/pictures/disc_kernel.hpp"

namespace posevote::pictures {
namespace {

struct Glyph {
  char letter;
  std::array<std::uint8_t, 7> rows;  ///< five dots a row, the leftmost in bit 4
};

constexpr Glyph kFont[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 2, 4, 8, 31}},     {'3', {31, 2, 4, 2, 1, 17, 14}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'A', {14, 17, 17, 31, 17, 17, 17}}, {'B', {30, 17, 17, 30, 17, 17, 30}},
    {'C', {14, 17, 16, 16, 16, 17, 14}}, {'D', {28, 18, 17, 17, 17, 18, 28}},
    {'E', {31, 16, 16, 30, 16, 16, 31}}, {'F', {31, 16, 16, 30, 16, 16, 16}},
    {'G', {14, 17, 16, 23, 17, 17, 15}}, {'H', {17, 17, 17, 31, 17, 17, 17}},
    {'I', {14, 4, 4, 4, 4, 4, 14}},      {'J', {7, 2, 2, 2, 2, 18, 12}},
    {'K', {17, 18, 20, 24, 20, 18, 17}}, {'L', {16, 16, 16, 16, 16, 16, 31}},
    {'M', {17, 27, 21, 21, 17, 17, 17}}, {'N', {17, 17, 25, 21, 19, 17, 17}},
    {'O', {14, 17, 17, 17, 17, 17, 14}}, {'P', {30, 17, 17, 30, 16, 16, 16}},
    {'Q', {14, 17, 17, 17, 21, 18, 13}}, {'R', {30, 17, 17, 30, 20, 18, 17}},
    {'S', {15, 16, 16, 14, 1, 1, 30}},   {'T', {31, 4, 4, 4, 4, 4, 4}},
    {'U', {17, 17, 17, 17, 17, 17, 14}}, {'V', {17, 17, 17, 17, 17, 10, 4}},
    {'W', {17, 17, 17, 21, 21, 21, 10}}, {'X', {17, 17, 10, 4, 10, 17, 17}},
    {'Y', {17, 17, 17, 10, 4, 4, 4}},    {'Z', {31, 1, 2, 4, 8, 16, 31}},
    {'.', {0, 0, 0, 0, 0, 12, 12}},      {'-', {0, 0, 0, 31, 0, 0, 0}},
    {'_', {0, 0, 0, 0, 0, 0, 31}},       {'%', {24, 25, 2, 4, 8, 19, 3}},
};

const Glyph* find_glyph(char letter) {
  const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  const auto* found = std::find_if(std::begin(kFont), std::end(kFont),
                                   [upper](const Glyph& glyph) { return glyph.letter == upper; });
  return found == std::end(kFont) ? nullptr : found;
}

std::uint32_t to_pixel(const Colour& colour) {
  std::uint32_t pixel = 0;
  for (int k = 2; k >= 0; --k)
    pixel = pixel << 8 |
            static_cast<std::uint32_t>(std::lround(255 * std::clamp(colour(k), 0.0F, 1.0F)));
  return pixel;
}

}  // namespace

Canvas::Canvas(int width, int height, const Colour& background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + kDiscPadding),
      depth_(pixels_.size(), std::numeric_limits<float>::infinity()) {
  fill(0, 0, width, height, background);
}

std::size_t Canvas::index(int row, int column) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(column);
}

void Canvas::fill(int x, int y, int width, int height, const Colour& colour) {
  const std::uint32_t pixel = to_pixel(colour);
  const int first = std::max(0, x), last = std::min(width_, x + width);
  for (int row = std::max(0, y); row < std::min(height_, y + height); ++row)
    for (int column = first; column < last; ++column) pixels_[index(row, column)] = pixel;
}

void Canvas::draw(const Disc& disc, const Colour& colour) {
  constexpr float kMost = 40;
  const bool in_reach = std::abs(disc.x) < 1e6F && std::abs(disc.y) < 1e6F;
  if (!in_reach || !(disc.radius >= 0) || !(disc.tilt.norm() <= 1e3F)) return;
  const float radius = std::min(disc.radius, kMost);
  const int reach = static_cast<int>(radius);
  const int center_x = static_cast<int>(std::lround(disc.x));
  const int center_y = static_cast<int>(std::lround(disc.y));
  const int left = std::max(0, center_x - reach), top = std::max(0, center_y - reach);
  const int columns = std::min(width_, center_x + reach + 1) - left;
  const int rows = std::min(height_, center_y + reach + 1) - top;
  if (columns <= 0 || rows <= 0) return;
  draw_disc({.left = left - center_x,
             .top = top - center_y,
             .columns = columns,
             .rows = rows,
             .depths = &depth_[index(top, left)],
             .pixels = &pixels_[index(top, left)],
             .stride = static_cast<std::size_t>(width_),
             .radius = radius,
             .tilt_x = disc.tilt.x(),
             .tilt_y = disc.tilt.y(),
             .depth = disc.depth,
             .pixel_size = disc.pixel},
            to_pixel(colour));
}

void Canvas::outline(const Canvas& shape, int width, const Colour& colour) {
  const std::uint32_t pixel = to_pixel(colour);
  const auto is_drawn = [&shape](int row, int column) {
    return row >= 0 && column >= 0 && row < shape.height_ && column < shape.width_ &&
           std::isfinite(shape.depth_[shape.index(row, column)]);
  };
  for (int row = 0; row < height_; ++row)
    for (int column = 0; column < width_; ++column)
      if (is_drawn(row, column) &&
          !(is_drawn(row - width, column) && is_drawn(row + width, column) &&
            is_drawn(row, column - width) && is_drawn(row, column + width)))
        pixels_[index(row, column)] = pixel;
}

Canvas Canvas::halved() const {
  constexpr std::uint32_t kOuter = 0x00FF00FF, kGreen = 0x0000FF00;
  Canvas half(width_ / 2, height_ / 2, Colour::Zero());
  for (int row = 0; row < half.height_; ++row)
    for (int column = 0; column < half.width_; ++column) {
      const std::uint32_t* above = &pixels_[index(2 * row, 2 * column)];
      const std::uint32_t* below = &pixels_[index(2 * row + 1, 2 * column)];
      const auto mean = [&](std::uint32_t mask, std::uint32_t round) {
        const std::uint32_t sum =
            (above[0] & mask) + (above[1] & mask) + (below[0] & mask) + (below[1] & mask);
        return (sum + round) / 4 & mask;
      };
      half.pixels_[half.index(row, column)] = mean(kOuter, 0x00020002) | mean(kGreen, 0x00000200);
    }
  return half;
}

void Canvas::text(int x, int y, int size, const std::string& words, const Colour& colour) {
  const int step = 6 * size;
  fill(x - size, y - size, static_cast<int>(words.size()) * step + size, 9 * size,
       {0.1F, 0.1F, 0.1F});
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Glyph* glyph = find_glyph(words[i]);
    if (!glyph) continue;
    for (int row = 0; row < 7; ++row)
      for (int dot = 0; dot < 5; ++dot)
        if ((glyph->rows[static_cast<std::size_t>(row)] >> (4 - dot)) & 1)
          fill(x + static_cast<int>(i) * step + dot * size, y + row * size, size, size, colour);
  }
}

void Canvas::save(const std::filesystem::path& png) const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * pixels_.size());
  for (std::size_t i = 0; i < pixels_.size() - kDiscPadding; ++i)
    for (int shift = 0; shift < 24; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(pixels_[i] >> shift));
  formats::write_png(png, static_cast<std::size_t>(width_), static_cast<std::size_t>(height_),
                     PNG_FORMAT_RGB, bytes.data(),
                     PNG_IMAGE_FLAG_FAST);  // a tenth larger, much faster
}

Colour distinct_colour(std::size_t i) {
  static const std::array<Colour, 10> colours{
      Colour{0.90F, 0.29F, 0.23F}, Colour{0.25F, 0.65F, 0.32F}, Colour{0.25F, 0.47F, 0.85F},
      Colour{0.95F, 0.68F, 0.16F}, Colour{0.63F, 0.35F, 0.75F}, Colour{0.20F, 0.70F, 0.72F},
      Colour{0.93F, 0.47F, 0.65F}, Colour{0.60F, 0.72F, 0.20F}, Colour{0.60F, 0.43F, 0.30F},
      Colour{0.45F, 0.52F, 0.60F}};
  return colours[i % colours.size()];
}

}  // namespace posevote::pictures
