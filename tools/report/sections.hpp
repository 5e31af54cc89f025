// SPDX-License-Identifier: BSD-3-Clause
// What the commands leave in a folder, as sections of a page.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/report/html.hpp"
#include "tools/report/report.hpp"
#include "tools/report/run_data.hpp"

namespace posevote {

/// Of `posevote run`, from the folder that holds it. `where`: the folder's name in the title; empty:
/// the page is about it. `id`: unique on the page.
html::Section run_section(const std::filesystem::path& folder, const std::string& where,
                          const page::TruthSource& truth, const page::RunView& view,
                          const std::string& id);

/// Of `posevote evaluate`.
std::vector<html::Section> evaluation_sections(const std::filesystem::path& folder,
                                               const std::string& where);

/// Of `posevote experiment` and `bench --growth`: each NAME.csv with NAME.json and NAME.svg.
std::vector<html::Section> experiment_sections(const std::filesystem::path& folder,
                                               const std::string& where);

}  // namespace posevote
