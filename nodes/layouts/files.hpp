// SPDX-License-Identifier: BSD-3-Clause
// What layouts share: folders and files of numbers, and complaints that name them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/formats/json_text.hpp"

namespace posevote::layouts {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);
/// The number that a name of digits says, or -1.
int number_of(const std::string& digits);
/// entry[name], which must be a whole number of at least `least`. Throws std::invalid_argument.
int whole(const nlohmann::json& entry, const std::string& name, int least = 0);
nlohmann::json read_json(const std::filesystem::path& file);
/// The entries of a folder, sorted by path; none where there is no such folder.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);
/// As people count: scan2 before scan10.
bool in_natural_order(const std::string& a, const std::string& b);
/// obj_id of each model file: from `obj_NNNNNN` names, else 1.. by the names in natural order, in
/// whatever order they are given; a file that is given twice counts once. Throws std::runtime_error for two models of one obj_id.
std::map<int, std::filesystem::path> number_models(std::vector<std::filesystem::path> files);

/// A list of so many numbers. Throws std::invalid_argument, which names it.
std::vector<double> numbers(const nlohmann::json& list, std::size_t count, const std::string& name);
/// A point or way in mm as one in metres.
inline constexpr double kMetresPerUnit = 0.001;
Eigen::Vector3d metres(const nlohmann::json& list, const std::string& name);

/// Runs `read`; what is wrong with the file's types or keys is reported with the place in it.
template <class Read>
auto located(const std::filesystem::path& file, const std::string& place, const Read& read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    fail(file, place + ": " + formats::reason_of(error));
  } catch (const std::invalid_argument& error) {
    fail(file, place + ": " + error.what());
  }
}

}  // namespace posevote::layouts
