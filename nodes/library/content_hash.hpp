// SPDX-License-Identifier: BSD-3-Clause
// What files and records hold, as a number that tells it from anything else: XXH3-128, written as 32
// hexadecimal digits. It guards against accidents, not against forgers.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace posevote::library {

std::string checksum(std::string_view bytes);

/// Over the files' lengths and bytes, in this order, and the text. Throws std::runtime_error naming a
/// file that cannot be read.
std::string hash_files(const std::vector<std::filesystem::path>& files, const std::string& text);

}  // namespace posevote::library
