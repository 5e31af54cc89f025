// SPDX-License-Identifier: BSD-3-Clause
// How JSON that others wrote is read. The library parses any depth, but overflows the stack when it
// copies or destroys what is nested 100 000 deep.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace posevote::formats {

/// Deeper than any file that we read or write.
inline constexpr int kMostNesting = 64;

/// For nlohmann::json and ordered_json. Throws std::runtime_error "is no JSON: ... line 3, column 7"
/// or "is nested deeper than 64".
template <class Json>
Json parse_json(std::string_view text);

/// A file's; throws the same behind the file's name, or that it cannot be read.
template <class Json>
Json read_json(const std::filesystem::path& file);

/// A value as messages show it: as JSON, without the middle of a long one.
std::string shown(const nlohmann::json& value);

/// What an exception of the library says, without its number.
std::string reason_of(const nlohmann::json::exception& error);

}  // namespace posevote::formats
