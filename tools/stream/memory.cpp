// SPDX-License-Identifier: BSD-3-Clause
#include "tools/stream/memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <climits>
#include <fstream>
#include <set>
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

/// One image of each topic stands for all: to look at each would be to read the whole file.
bool is_like_another(const SceneEntry& scan, std::set<std::filesystem::path>& known) {
  const std::filesystem::path& path = scan.file.path;
  return !formats::container_of(path).empty() && !known.insert(path.parent_path()).second;
}

}  // namespace

std::size_t expected_bytes(const SceneFile& file) {
  if (file.points || file.depth) return 0;
  if (const formats::Format* format = formats::find_format(file.path); format && format->entry)
    return kBytesOfPixel * size_of_entry(*format, file.path) / sizeof(std::uint16_t);
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

std::size_t tokens_within(std::size_t memory, std::size_t tokens,
                          const std::vector<SceneEntry>& scans) {
  std::size_t largest = 1;
  std::set<std::filesystem::path> known;
  for (const SceneEntry& scan : scans)
    if (!is_like_another(scan, known)) largest = std::max(largest, expected_bytes(scan.file));
  return std::clamp<std::size_t>(memory / largest, 1, tokens);
}

int most_points(std::size_t memory) {
  return static_cast<int>(std::clamp<std::size_t>(memory / kBytesOfPixel, 1, INT_MAX));
}

}  // namespace posevote::stream
