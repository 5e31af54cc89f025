// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <png.h>

#include <cstddef>
#include <filesystem>

namespace posevote::formats {

/// Writes pixels, row by row. `format`: one of libpng's (PNG_FORMAT_...), of the pixels; `flags`: of
/// its PNG_IMAGE_FLAG_... The file appears whole or not at all. Throws std::runtime_error naming it if
/// it cannot be written.
void write_png(const std::filesystem::path& file, std::size_t width, std::size_t height,
               png_uint_32 format, const void* pixels, png_uint_32 flags = 0);

}  // namespace posevote::formats
