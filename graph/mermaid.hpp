// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "graph/plan.hpp"

namespace posevote::graph {

/// The wiring of plans as `to_dot` draws it, for where Markdown is shown (Mermaid's flowchart).
/// Plans without nodes are left out.
std::string to_mermaid(const std::vector<const Plan*>& plans);

}  // namespace posevote::graph
