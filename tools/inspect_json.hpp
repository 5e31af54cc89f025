// SPDX-License-Identifier: BSD-3-Clause
// What `nodes`, `check` and `graph` say with --json.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "graph/plan.hpp"
#include "graph/problem.hpp"
#include "graph/registry.hpp"

namespace posevote {

/// A node type: ports and parameters.
nlohmann::ordered_json to_json(const graph::NodeSpec& spec);
nlohmann::ordered_json to_json(const std::vector<const graph::NodeSpec*>& specs);

/// The nodes of a plan in their order, with the streams that link them.
nlohmann::ordered_json to_json(const graph::Plan& plan);

/// Line and column are 0 where the file, or an argument, is meant as a whole.
nlohmann::ordered_json to_json(const std::vector<graph::Problem>& problems);

}  // namespace posevote
