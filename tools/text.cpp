// SPDX-License-Identifier: BSD-3-Clause
#include "tools/text.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

namespace posevote {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  if (!text.empty() && text.back() == separator) parts.emplace_back();
  return parts;
}

std::string mend_utf8(const std::string& text) {
  using nlohmann::json;
  const std::string mended = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(mended).get<std::string>();
}

std::string escape_markup(const std::string& text) {
  std::string safe;
  for (const char c : mend_utf8(text)) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
      safe += c;
  }
  return safe;
}

std::string printable(const std::string& text) {
  std::string safe;
  const std::string mended = mend_utf8(text);
  for (std::size_t i = 0; i < mended.size(); ++i) {
    auto code = static_cast<unsigned char>(mended[i]);
    const auto next = static_cast<unsigned char>(i + 1 < mended.size() ? mended[i + 1] : 0);
    const bool second_set = code == 0xC2 && next < 0xA0;  // C1, U+0080 to U+009F
    if (second_set) code = next, ++i;
    if (code < 0x20 || code == 0x7F || second_set)
      safe += format("\\x%02x", code);
    else
      safe += mended[i];
  }
  return safe;
}

std::string quote_for_shell(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 60) return format("%lld s", whole);
  if (whole < 3600) return format("%lld min %02lld s", whole / 60, whole % 60);
  return format("%lld h %02lld min", whole / 3600, whole % 3600 / 60);
}

}  // namespace posevote
