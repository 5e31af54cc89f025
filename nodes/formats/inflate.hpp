// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace posevote::formats {

/// What `bytes` hold, which must be `size` bytes; never takes more memory than comes of them.
/// `compression`: "bz2" or "lz4" (its frame format). Throws std::runtime_error that says what is
/// wrong.
std::string inflate(std::string_view bytes, const std::string& compression, std::size_t size);

}  // namespace posevote::formats
