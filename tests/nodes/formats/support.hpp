// SPDX-License-Identifier: BSD-3-Clause
// What the tests of formats and of loading share: bytes of a given order, files in a folder of
// their own, and the text of an error.
#pragma once

#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/formats/format.hpp"

namespace posevote::test {

/// A folder that is removed with the test.
class TempDir {
 public:
  TempDir() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("posevote_load_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TempDir() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;

  std::filesystem::path path(const std::string& name) const { return path_ / name; }
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

template <class T>
void append(std::string& out, T value, std::endian order = std::endian::little) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

/// The body of a compressed PCD file: both sizes, then LZF of nothing but literals, up to 32 a run.
inline std::string lzf_block(const std::string& plain) {
  std::string packed;
  for (std::size_t i = 0; i < plain.size(); i += 32) {
    const std::string run = plain.substr(i, 32);
    packed += static_cast<char>(run.size() - 1) + run;
  }
  std::string block;
  append(block, static_cast<std::uint32_t>(packed.size()));
  append(block, static_cast<std::uint32_t>(plain.size()));
  return block + packed;
}

/// What the reader of an ending, ".ply", makes of a file's bytes.
inline formats::RawMesh read_raw(const std::string& ending, std::string_view bytes) {
  const formats::Format* format = formats::find_format("file" + ending);
  if (!format) throw std::logic_error("no format has the ending " + ending);
  return std::get<formats::ReadMesh>(format->read)(bytes);
}

/// The text of the std::runtime_error that `action` throws. Any other exception fails the test.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "(no error)";
}

inline Catch::Matchers::StdString::ContainsMatcher has(const std::string& text) {
  return Catch::Matchers::Contains(text);
}

/// A grey PNG of 8 or 16 bits, or 8-bit RGB for `channels` 3. Samples of 16 bits are big-endian.
inline std::string png_bytes(std::uint32_t width, std::uint32_t height, int bits, int channels,
                             const std::string& samples, int interlace = PNG_INTERLACE_NONE) {
  std::string out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &out,
      [](png_structp p, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))
            ->append(reinterpret_cast<const char*>(data), size);
      },
      nullptr);
  png_set_IHDR(png, info, width, height, bits,
               channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const std::size_t stride = std::size_t{width} * static_cast<std::size_t>(channels * bits / 8);
  std::string pixels = samples;
  std::vector<png_bytep> rows;
  for (std::size_t v = 0; v < height; ++v)
    rows.push_back(reinterpret_cast<png_bytep>(pixels.data() + v * stride));
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return out;
}

inline std::string depth_png(std::uint32_t width, std::uint32_t height,
                             const std::vector<std::uint16_t>& values,
                             int interlace = PNG_INTERLACE_NONE) {
  std::string samples;
  for (const std::uint16_t value : values) append(samples, value, std::endian::big);
  return png_bytes(width, height, 16, 1, samples, interlace);
}

/// A NumPy array in a file.
inline std::string npy(const std::string& descr, const std::string& shape, const std::string& data,
                       const std::string& fortran = "False") {
  std::string header =
      "{'descr': '" + descr + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }";
  header.append(64 - (header.size() + 11) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  append(bytes, static_cast<std::uint16_t>(header.size()));
  return bytes + header + data;
}

template <class T>
std::string values(const std::vector<T>& list, std::endian order = std::endian::little) {
  std::string bytes;
  for (const T value : list) append(bytes, value, order);
  return bytes;
}

/// What every loaded scan must be, however the file looked.
inline bool is_valid(const Scan& scan) {
  const Eigen::Index n = scan.points.rows();
  if (n == 0 || !scan.points.allFinite() || !scan.view.origin.allFinite()) return false;
  if (scan.normals.rows() != 0 && scan.normals.rows() != n) return false;
  for (Eigen::Index i = 0; i < scan.normals.rows(); ++i) {
    const float length = scan.normals.row(i).norm();
    if (length != 0.0F && !(std::abs(length - 1) < 1e-5F)) return false;
  }
  return scan.faces.rows() == 0 || scan.faces.maxCoeff() < static_cast<std::uint32_t>(n);
}

}  // namespace posevote::test
