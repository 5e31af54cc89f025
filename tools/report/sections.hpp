// SPDX-License-Identifier: BSD-3-Clause
// What the commands leave in a folder, as sections of a page.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/report/html.hpp"

namespace posevote {

/// Of `posevote run`. `where`: the folder's name in the title; empty: the page is about it.
/// `pictures`: how many the page still may hold.
std::vector<html::Section> run_sections(const std::filesystem::path& folder,
                                        const std::string& where, std::size_t& pictures);

/// Of `posevote evaluate`.
std::vector<html::Section> evaluation_sections(const std::filesystem::path& folder,
                                               const std::string& where);

/// Of `posevote experiment` and `bench --growth`: each NAME.csv with NAME.json and NAME.svg.
std::vector<html::Section> experiment_sections(const std::filesystem::path& folder,
                                               const std::string& where);

}  // namespace posevote
