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

}  // namespace posevote
