// SPDX-License-Identifier: BSD-3-Clause
// Calls one planned node: its function once, or, lifted, once for each object in parallel.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "graph/activity.hpp"
#include "graph/plan.hpp"

namespace posevote::graph {

/// What to tell of an exception; "out of memory" for std::bad_alloc.
std::string reason_of(const std::exception& error);

/// Returns a value for each output of the node's type. `state`: for a node that keeps one; `call`:
/// told of the objects of a lifted one, unless null. Throws
/// what the node throws; a lifted one ObjectErrors, whose what() is "object I: ", counted from 1,
/// and why the first of them failed.
std::vector<Value> call_node(const PlannedNode& node, const std::vector<Value>& inputs,
                             const FrameContext& context, void* state = nullptr,
                             Activity::Call* call = nullptr);

}  // namespace posevote::graph
