// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tools/text.hpp"

namespace posevote::html {
namespace {

const char* class_of(Kind kind) {
  return kind == Kind::kNumber ? " class=\"number\"" : kind == Kind::kLong ? " class=\"long\"" : "";
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63U];
  }
  return text;
}

std::string image(const std::string& type, std::string_view bytes, const std::string& description,
                  const std::string& attributes) {
  return fmt::format("<img {} alt=\"{}\" src=\"data:image/{};base64,{}\"/>", attributes,
                     escape_markup(description), type, base64(bytes));
}

std::string path(const std::string& file) {
  std::string text;
  for (const char c : escape_markup(file)) text += c == '/' ? "/<wbr/>" : std::string(1, c);
  return text;
}

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string cell(const std::string& markup, const Column& column, std::size_t rows) {
  return fmt::format("<td{}{}>{}</td>", class_of(column.kind),
                     rows > 1 ? fmt::format(" rowspan=\"{}\"", rows) : "", markup);
}

std::string table(const std::vector<Column>& columns, const std::string& body) {
  std::string text = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const Column& column : columns)
    text += fmt::format("<th{}>{}</th>", class_of(column.kind), escape_markup(column.head));
  return text + "</tr></thead>\n" + body + "</table></div>\n";
}

std::string table(const std::vector<Column>& columns, const std::vector<Row>& rows,
                  std::size_t most) {
  std::string body = "<tbody>\n";
  for (std::size_t r = 0; r < std::min(most, rows.size()); ++r) {
    body += "<tr>";
    for (std::size_t c = 0; c < columns.size(); ++c)
      body += cell(c < rows[r].size() ? rows[r][c] : "", columns[c]);
    body += "</tr>\n";
  }
  const std::string text = table(columns, body + "</tbody>");
  return rows.size() <= most ? text
                             : text + paragraph(fmt::format("and {} more", rows.size() - most));
}

std::string heading(const std::string& text) { return "<h3>" + escape_markup(text) + "</h3>\n"; }

std::string paragraph(const std::string& text) { return "<p>" + escape_markup(text) + "</p>\n"; }

std::string fold(const std::string& summary, const std::string& markup, bool open) {
  return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n",
                     open ? " open=\"open\"" : "", escape_markup(summary), markup);
}

}  // namespace posevote::html
