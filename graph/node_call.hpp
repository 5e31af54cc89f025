// SPDX-License-Identifier: BSD-3-Clause
// Calls one planned node: its function once, or, lifted, once for each object in parallel.
#pragma once

#include <vector>

#include "graph/plan.hpp"

namespace posevote::graph {

/// Returns the output value (null for a node that only writes). Throws what the node throws; of
/// several failing objects, the first one's exception, as std::runtime_error "object I: what".
Value call_node(const PlannedNode& node, const std::vector<Value>& inputs,
                const FrameContext& context);

}  // namespace posevote::graph
