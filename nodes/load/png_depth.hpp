// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace posevote::load {

struct DepthImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint16_t> values;  ///< raw, row by row
};

/// Decodes a 16-bit grey PNG. Throws std::runtime_error for anything else, and for damaged files.
DepthImage decode_depth_png(std::string_view bytes);

}  // namespace posevote::load
