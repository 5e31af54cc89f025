// SPDX-License-Identifier: BSD-3-Clause
// What BOP's models_info.json says of a model: lengths in mm, matrices row by row.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "nodes/data/symmetries.hpp"
#include "nodes/layouts/ground_truth.hpp"

namespace posevote::layouts {

/// `symmetries_discrete` of an entry [m], identity first. Throws std::invalid_argument or
/// nlohmann::json::exception.
std::vector<Eigen::Isometry3d> read_symmetries(const nlohmann::json& info);
/// `symmetries_continuous` of an entry [m]. Throws as above.
std::vector<SymmetryAxis> read_axes(const nlohmann::json& info);

/// By obj_id the symmetries of those models of which the file lists any, if only an empty list;
/// nothing where there is no such file. Throws std::runtime_error, which names the file and the
/// object.
std::map<int, Symmetries> known_symmetries(const std::filesystem::path& models_info);

}  // namespace posevote::layouts
