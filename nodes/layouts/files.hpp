// SPDX-License-Identifier: BSD-3-Clause
// What layouts share: folders and files of numbers, and complaints that name them.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace posevote::layouts {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);
/// The number that a name of digits says, or -1.
int number_of(const std::string& digits);
/// entry[name], which must be a whole number of at least `least`. Throws std::invalid_argument.
int whole(const nlohmann::json& entry, const std::string& name, int least = 0);
nlohmann::json read_json(const std::filesystem::path& file);
/// The entries of a folder, sorted by path; none where there is no such folder.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);
/// obj_id of each model file: from `obj_NNNNNN` names, else 1.. by the sort of all names, in
/// whatever order they are given. Throws std::runtime_error for two models of one obj_id.
std::map<int, std::filesystem::path> number_models(std::vector<std::filesystem::path> files);

}  // namespace posevote::layouts
