// SPDX-License-Identifier: BSD-3-Clause
#include "tools/stream/memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <climits>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"

namespace posevote::stream {
namespace {

/// Measured on images of 2048 and 4096 pixels aside in which all are measured: 58 bytes of each.
constexpr std::size_t kBytesOfPixel = 64;
/// Of a point file's bytes: as many for a point, of which a file has 12 at least.
constexpr std::size_t kBytesOfByte = 6;

/// Of a PNG, whose head says it; 0 of other files.
std::size_t pixels_of_png(const std::filesystem::path& file) {
  constexpr std::size_t kHead = 24, kWidth = 16, kHeight = 20;
  char head[kHead] = {};
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(head, kHead) || std::string_view(head + 1, 3) != "PNG") return 0;
  const auto number = [&](std::size_t at) {
    return std::size_t{formats::load_bytes<std::uint32_t>(head + at, std::endian::big)};
  };
  return number(kWidth) * number(kHeight);
}

/// Of what lies in a file of many images; 0 where it cannot be read, for its frame to fail on.
std::size_t size_of_entry(const formats::Format& format, const std::filesystem::path& path) try {
  return format.entry(path).size();
} catch (const std::runtime_error&) {
  return 0;
}

}  // namespace

std::size_t ScanSizes::expected(const SceneFile& file) {
  if (file.points || file.depth) return 0;
  if (const formats::Format* format = formats::find_format(file.path); format && format->entry) {
    const auto [topic, is_new] = of_topics_.try_emplace(file.path.parent_path(), 0);
    if (is_new)
      topic->second = kBytesOfPixel * size_of_entry(*format, file.path) / sizeof(std::uint16_t);
    return topic->second;
  }
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file.path, none);
  if (none) return 0;
  if (!formats::has_ending(file.path, formats::Wanted::kDepthImages)) return kBytesOfByte * size;
  const std::size_t pixels = pixels_of_png(file.path);
  return kBytesOfPixel * (pixels > 0 ? pixels : size / sizeof(std::uint16_t));
}

std::size_t memory_limit(std::uint64_t asked) {
  if (asked > 0) return asked;
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) / 2 *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

int most_points(std::size_t memory) {
  return static_cast<int>(std::clamp<std::size_t>(memory / kBytesOfPixel, 1, INT_MAX));
}

}  // namespace posevote::stream
