// SPDX-License-Identifier: BSD-3-Clause
// What the readers of depth images hand over: numbers as they stand in the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace posevote::formats {

struct DepthImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint16_t> values;  ///< raw, row by row
};

/// The ending says how. Throws std::runtime_error that says what is wrong, but does not repeat the
/// path.
DepthImage read_depth_image(const std::filesystem::path& path);

}  // namespace posevote::formats
