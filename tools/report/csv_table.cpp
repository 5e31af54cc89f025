// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "graph/schema.hpp"
#include "tools/report/html.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

constexpr std::size_t kMostRows = 1000;

bool is_missing(const std::string& value) { return value.empty() || value == "null"; }

/// How a column is shown.
struct Style {
  html::Kind kind = html::Kind::kNumber;
  int digits = 0;  ///< behind the point: so that three of the largest count, none of whole numbers
};

Style style_of(const CsvTable& table, std::size_t column) {
  bool whole = true;
  double largest = 0;
  for (const auto& row : table.rows) {
    if (is_missing(row[column])) continue;
    const auto number = graph::Scalar<double>::parse(row[column]);
    if (!number) return {html::Kind::kText, 0};
    if (!std::isfinite(*number)) continue;
    whole = whole && *number == std::floor(*number);
    largest = std::max(largest, std::abs(*number));
  }
  if (whole) return {};
  return {html::Kind::kNumber,
          std::clamp(3 - static_cast<int>(std::ceil(std::log10(largest))), 2, 6)};
}

std::string show(const std::string& value, const Style& style) {
  if (is_missing(value)) return "-";
  if (style.kind == html::Kind::kText) return escape_markup(value);
  return html::number(*graph::Scalar<double>::parse(value), style.digits);
}

}  // namespace

CsvTable read_csv(const std::filesystem::path& file) {
  CsvTable table;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> cells = split(line, ',');
    if (table.heads.empty())
      table.heads = std::move(cells);
    else if (cells.size() == table.heads.size())
      table.rows.push_back(std::move(cells));
  }
  return table;
}

std::string to_markup(const CsvTable& table) {
  if (table.rows.empty()) return "";
  std::vector<html::Column> columns;
  std::vector<Style> styles;
  for (std::size_t c = 0; c < table.heads.size(); ++c) {
    std::string head = table.heads[c];
    std::replace(head.begin(), head.end(), '_', ' ');
    styles.push_back(style_of(table, c));
    columns.push_back({head, styles.back().kind});
  }
  std::vector<html::Row> rows;
  for (const auto& row : table.rows) {
    html::Row& cells = rows.emplace_back();
    for (std::size_t c = 0; c < row.size(); ++c) cells.push_back(show(row[c], styles[c]));
  }
  return html::table(columns, rows, kMostRows);
}

std::string to_markup_by_object(const CsvTable& table) {
  const auto object = std::find(table.heads.begin(), table.heads.end(), "object");
  if (object == table.heads.end()) return to_markup(table);
  const auto column = static_cast<std::size_t>(object - table.heads.begin());
  CsvTable all{table.heads, {}}, single{table.heads, {}};
  for (const auto& row : table.rows) (row[column] == "all" ? all : single).rows.push_back(row);
  if (all.rows.empty()) return to_markup(single);
  return to_markup(all) +
         (single.rows.empty() ? "" : html::fold("Object by object", to_markup(single)));
}

}  // namespace posevote
