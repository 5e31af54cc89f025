// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "nodes/data/texture.hpp"

namespace posevote::formats {

/// Reads a colour or grey image, PNG or JPEG, whichever its first bytes say. Throws
/// std::runtime_error that says what is wrong, but does not repeat the path.
ColorImage read_color_image(const std::filesystem::path& path);

/// Throws std::runtime_error naming the file if it cannot be written. `quality`: 1 to 100.
void write_jpeg(const ColorImage& image, int quality, const std::filesystem::path& path);

}  // namespace posevote::formats
