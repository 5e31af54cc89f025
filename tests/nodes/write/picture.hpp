// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <png.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "nodes/formats/write_ply.hpp"

namespace posevote::test {

/// A PNG, read back.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  explicit Picture(const std::filesystem::path& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, file.c_str()))
      throw std::runtime_error(image.message);
    image.format = PNG_FORMAT_RGB;
    pixels.resize(PNG_IMAGE_SIZE(image));
    if (!png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr))
      throw std::runtime_error(image.message);
    width = static_cast<int>(image.width);
    height = static_cast<int>(image.height);
  }
  formats::Rgb at(int x, int y) const {
    const auto i = 3 * static_cast<std::size_t>(y * width + x);
    return {pixels.at(i), pixels.at(i + 1), pixels.at(i + 2)};
  }
};

}  // namespace posevote::test
