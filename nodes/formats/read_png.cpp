// SPDX-License-Identifier: BSD-3-Clause
// Reads depth images: PNG, 16-bit grey.
//
// libpng reports errors by longjmp, which must not cross a living C++ object. So each function that
// calls setjmp holds none: what they need is made before and destroyed after them.
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"

namespace posevote::formats {
namespace {

constexpr png_uint_32 kMostPixelsAside = 8192;
constexpr std::uint64_t kMostDeflateRatio = 1032;

/// The input and the last error; libpng holds pointers to it.
struct State {
  std::string_view rest;
  char error[160] = "";
};

void on_error(png_structp png, png_const_charp message) {
  auto* state = static_cast<State*>(png_get_error_ptr(png));
  std::snprintf(state->error, sizeof state->error, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep out, std::size_t count) {
  auto* state = static_cast<State*>(png_get_io_ptr(png));
  if (count > state->rest.size()) png_error(png, "the file ends too early");
  std::memcpy(out, state->rest.data(), count);
  state->rest.remove_prefix(count);
}

/// Owns libpng's two structs.
struct Png {
  State state;
  png_structp png = nullptr;
  png_infop info = nullptr;

  explicit Png(std::string_view bytes) : state{bytes, ""} {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
    info = png ? png_create_info_struct(png) : nullptr;
    if (!info) {
      png_destroy_read_struct(&png, nullptr, nullptr);
      throw std::runtime_error("libpng could not start");
    }
  }
  ~Png() { png_destroy_read_struct(&png, &info, nullptr); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
};

bool read_header(Png& in) {
  if (setjmp(png_jmpbuf(in.png))) return false;
  png_set_read_fn(in.png, &in.state, on_read);
  png_set_user_limits(in.png, kMostPixelsAside, kMostPixelsAside);
  png_set_chunk_cache_max(in.png, 1);  // skip texts: they may unpack to any size
  png_read_info(in.png, in.info);
  return true;
}

bool read_pixels(Png& in, png_bytepp rows) {
  if (setjmp(png_jmpbuf(in.png))) return false;
  if (std::endian::native == std::endian::little) png_set_swap(in.png);
  png_set_interlace_handling(in.png);
  png_read_update_info(in.png, in.info);
  png_read_image(in.png, rows);
  png_read_end(in.png, nullptr);
  return true;
}

[[noreturn]] void fail(const Png& in) {
  throw std::runtime_error("damaged PNG file: " + std::string(in.state.error));
}

void check_kind(const Png& in) {
  const int bits = png_get_bit_depth(in.png, in.info);
  const int color = png_get_color_type(in.png, in.info);
  if (bits == 16 && color == PNG_COLOR_TYPE_GRAY) return;
  const std::string name = color == PNG_COLOR_TYPE_GRAY         ? "grey"
                           : color == PNG_COLOR_TYPE_GRAY_ALPHA ? "grey with alpha"
                           : color == PNG_COLOR_TYPE_PALETTE    ? "palette colour"
                                                                : "colour";
  throw std::runtime_error("not a depth image: " + std::to_string(bits) + "-bit " + name +
                           ", expected 16-bit grey");
}

DepthImage read_png(std::string_view bytes) {
  constexpr std::size_t kSignature = 8;
  const std::string head(bytes.substr(0, kSignature));
  if (head.size() < kSignature ||
      png_sig_cmp(reinterpret_cast<png_const_bytep>(head.data()), 0, kSignature) != 0)
    throw std::runtime_error("not a PNG file: starts with " + in_quotes(bytes));
  Png in(bytes);
  if (!read_header(in)) fail(in);
  check_kind(in);
  DepthImage image;
  image.width = png_get_image_width(in.png, in.info);
  image.height = png_get_image_height(in.png, in.info);
  const std::uint64_t size = std::uint64_t{image.width} * image.height * 2;
  if (size > kMostDeflateRatio * bytes.size())
    throw std::runtime_error("damaged PNG file: claims " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels, more than its " +
                             std::to_string(bytes.size()) + " bytes can hold");
  image.values.resize(image.width * image.height);
  std::vector<png_bytep> rows(image.height);
  for (std::size_t v = 0; v < image.height; ++v)
    rows[v] = reinterpret_cast<png_bytep>(image.values.data() + v * image.width);
  if (!read_pixels(in, rows.data())) fail(in);
  return image;
}

const auto registered = register_format("PNG", {".png"}, read_png);

}  // namespace
}  // namespace posevote::formats
