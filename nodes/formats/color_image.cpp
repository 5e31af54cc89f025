// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/color_image.hpp"

#include <png.h>
#include <turbojpeg.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "graph/write_file.hpp"
#include "nodes/formats/file_bytes.hpp"

namespace posevote::formats {
namespace {

constexpr std::size_t kMostPixelsAside = 16384;
constexpr std::uint64_t kMostRatio = 3100;  // pixels' bytes over the file's: deflate's, of one byte

/// Checked before anything is allocated.
ColorImage empty_image(std::size_t width, std::size_t height, std::size_t bytes) {
  if (width == 0 || height == 0 || width > kMostPixelsAside || height > kMostPixelsAside ||
      std::uint64_t{width} * height * 3 > kMostRatio * bytes)
    throw std::runtime_error("damaged image: claims " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels");
  return {width, height, std::vector<std::uint8_t>(width * height * 3)};
}

ColorImage read_png(std::string_view bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> release(&png, &png_image_free);
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0)
    throw std::runtime_error(std::string("damaged PNG file: ") + png.message);
  png.format = PNG_FORMAT_RGB;
  ColorImage image = empty_image(png.width, png.height, bytes.size());
  const png_color black{0, 0, 0};  // behind what is transparent
  if (png_image_finish_read(&png, &black, image.values.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("damaged PNG file: ") + png.message);
  return image;
}

struct DestroyJpeg {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Jpeg = std::unique_ptr<std::remove_pointer_t<tjhandle>, DestroyJpeg>;

Jpeg started(tjhandle handle) {
  if (!handle) throw std::runtime_error("libjpeg could not start");
  return Jpeg(handle);
}

[[noreturn]] void fail(const Jpeg& jpeg, const std::string& what) {
  throw std::runtime_error(what + tjGetErrorStr2(jpeg.get()));
}

ColorImage read_jpeg(std::string_view bytes) {
  const Jpeg jpeg = started(tjInitDecompress());
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, sampling = 0, space = 0;
  if (tjDecompressHeader3(jpeg.get(), data, bytes.size(), &width, &height, &sampling, &space) != 0)
    fail(jpeg, "damaged JPEG file: ");
  if (width == 0 || height == 0) throw std::runtime_error("damaged JPEG file: has no header");
  ColorImage image =
      empty_image(static_cast<std::size_t>(width), static_cast<std::size_t>(height), bytes.size());
  if (tjDecompress2(jpeg.get(), data, bytes.size(), image.values.data(), width, 0, height, TJPF_RGB,
                    TJFLAG_ACCURATEDCT) != 0)
    fail(jpeg, "damaged JPEG file: ");
  return image;
}

}  // namespace

ColorImage read_color_image(const std::filesystem::path& path) {
  const FileBytes bytes = read_file(path);
  const std::string_view view = bytes.view();
  if (view.starts_with("\x89PNG\r\n\x1a\n")) return read_png(view);
  if (view.starts_with("\xff\xd8\xff")) return read_jpeg(view);
  throw std::runtime_error("neither a PNG nor a JPEG image: starts with " + in_quotes(view));
}

void write_jpeg(const ColorImage& image, int quality, const std::filesystem::path& path) {
  const Jpeg jpeg = started(tjInitCompress());
  unsigned char* packed = nullptr;
  unsigned long size = 0;
  const int failed = tjCompress2(jpeg.get(), image.values.data(), static_cast<int>(image.width), 0,
                                 static_cast<int>(image.height), TJPF_RGB, &packed, &size,
                                 TJSAMP_420, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> release(packed, &tjFree);
  if (failed != 0) fail(jpeg, path.string() + ": cannot be made a JPEG: ");
  graph::write_file(path, {reinterpret_cast<const char*>(packed), size});
}

}  // namespace posevote::formats
