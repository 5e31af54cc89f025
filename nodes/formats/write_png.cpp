// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/write_png.hpp"

#include <stdexcept>
#include <string>

#include "graph/write_file.hpp"

namespace posevote::formats {

void write_png(const std::filesystem::path& file, std::size_t width, std::size_t height,
               png_uint_32 format, const void* pixels, png_uint_32 flags) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  image.flags = flags;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr) == 0)
    throw std::runtime_error(file.string() + ": cannot be written: " + image.message);
  bytes.resize(size);
  graph::write_file(file, bytes);
}

}  // namespace posevote::formats
