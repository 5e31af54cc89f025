// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of a picture, with the widest vector instructions of the processor it runs on.
#pragma once

#include <cstddef>
#include <cstdint>

namespace posevote::pictures {

/// What may be read, and written as it was, behind the last pixel of a picture.
inline constexpr std::size_t kDiscPadding = 16;

/// A rectangle of a picture and the disc that is drawn in it.
struct DiscArea {
  int left, top;      ///< of the rectangle, from the disc's center [pixel]
  int columns, rows;  ///< of the rectangle [pixel]
  float* depths;      ///< of its first pixel
  std::uint32_t* pixels;
  std::size_t stride;       ///< from row to row of the picture
  float radius;             ///< [pixel]
  float tilt_x, tilt_y;     ///< gain of depth per pixel, in pixels
  float depth, pixel_size;  ///< depth of the center, and what a pixel of gain adds to it
};

/// Sets pixel and depth where dx^2 + dy^2 + (tilt . (dx, dy))^2 <= radius^2 and nothing as near is.
void draw_disc(const DiscArea& area, std::uint32_t pixel);

}  // namespace posevote::pictures
