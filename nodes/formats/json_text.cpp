// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/json_text.hpp"

#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"

namespace posevote::formats {
namespace {

/// The first character of UTF-8 at `at` or behind.
std::size_t character_at(const std::string& text, std::size_t at) {
  while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  return at;
}

/// What a message repeats may be most of a file: what the library read last, blanks included, behind
/// which stands what it expected, or a value.
std::string without_middle(const std::string& text) {
  constexpr std::size_t kMost = 400, kBegin = 200, kEnd = 150;
  if (text.size() <= kMost) return text;
  return text.substr(0, character_at(text, kBegin)) + " ... " +
         text.substr(character_at(text, text.size() - kEnd));
}

}  // namespace

template <class Json>
Json parse_json(std::string_view text) {
  const auto bound = [](int depth, typename Json::parse_event_t, Json&) {
    if (depth > kMostNesting)
      throw std::runtime_error("is nested deeper than " + std::to_string(kMostNesting));
    return true;
  };
  try {
    return Json::parse(text, bound);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error("is no JSON: " + reason_of(error));
  }
}

template <class Json>
Json read_json(const std::filesystem::path& file) {
  try {
    return parse_json<Json>(read_file(file).view());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::string shown(const nlohmann::json& value) {
  return without_middle(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

template nlohmann::json parse_json(std::string_view text);
template nlohmann::ordered_json parse_json(std::string_view text);
template nlohmann::json read_json(const std::filesystem::path& file);
template nlohmann::ordered_json read_json(const std::filesystem::path& file);

std::string reason_of(const nlohmann::json::exception& error) {
  const std::string text = error.what();  // "[json.exception.type_error.302] type must be ..."
  const std::size_t end = text.starts_with("[json.") ? text.find("] ") : std::string::npos;
  return without_middle(end == std::string::npos ? text : text.substr(end + 2));
}

}  // namespace posevote::formats
