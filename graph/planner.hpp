// SPDX-License-Identifier: BSD-3-Clause
// The steps of make_plan (graph/plan.hpp), for itself. Each goes on where others found problems.
#pragma once

#include <string>
#include <vector>

#include "graph/plan.hpp"

namespace posevote::graph::detail {

/// The node with its type and parameters, not yet linked to others. Its type is null where there is
/// none of that name.
PlannedNode plan_node(const NodeDescription& node, std::vector<Problem>& problems);

/// Makes the nodes' streams and links them.
Plan wire(const PipelineDescription& description, const PlanEnds& ends,
          std::vector<Problem>& problems);

/// Puts producers first, else leaves nodes in the order in which they are written.
void order_nodes(Plan& plan, std::vector<Problem>& problems);

/// Gives every stream its type, says what is lifted and what is constant.
void check_types(Plan& plan, const PipelineDescription& description, const PlanEnds& ends,
                 std::vector<Problem>& problems);

}  // namespace posevote::graph::detail
