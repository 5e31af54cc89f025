// SPDX-License-Identifier: BSD-3-Clause
// What a plan is made of, for those who ask.
#pragma once

#include <map>
#include <string>

#include "graph/plan.hpp"

namespace posevote::graph {

/// The first node of that type, or null.
const PlannedNode* find_type(const Plan& plan, const std::string& type);

/// What a node's parameter is set to, as text. Throws std::out_of_range where it has none of that
/// name.
std::string value_of(const PlannedNode& node, const std::string& param);

/// How each node is wired: "match_features" -> "match_features(library, scene_features) ->
/// correspondences".
std::map<std::string, std::string> wiring(const Plan& plan);

}  // namespace posevote::graph
