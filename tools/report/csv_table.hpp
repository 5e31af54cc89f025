// SPDX-License-Identifier: BSD-3-Clause
// Tables that the commands write for spreadsheets, on a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace posevote {

/// Plain values: names without commas, and numbers.
struct CsvTable {
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;
};

/// Rows that have less or more cells than there are heads, as torn ones may, are left out. Nothing
/// where there is no such file.
CsvTable read_csv(const std::filesystem::path& file);

/// Numbers are shortened, and their columns to the right; "" of no rows.
std::string to_markup(const CsvTable& table);

/// Where there is a column `object`: the rows over "all" of them, then, folded, the others.
std::string to_markup_by_object(const CsvTable& table);

}  // namespace posevote
