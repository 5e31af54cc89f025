// SPDX-License-Identifier: BSD-3-Clause
// Calls one planned node: its function once, or, lifted, once for each object in parallel.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/plan.hpp"

namespace posevote::graph {

/// What to tell of an exception; "out of memory" for std::bad_alloc.
std::string reason_of(const std::exception& error);

/// What a node threw for one of the objects; what() begins with "object I: ", counted from 1.
class ObjectError : public std::runtime_error {
 public:
  ObjectError(std::size_t object_index, const std::string& reason)
      : std::runtime_error("object " + std::to_string(object_index + 1) + ": " + reason),
        object(object_index),
        cause(reason) {}

  std::size_t object;  ///< counted from 0
  std::string cause;
};

/// Returns a value for each output of the node's type. `state`: for a node that keeps one. Throws
/// what the node throws; of several failing objects, the first one's exception, as an ObjectError.
std::vector<Value> call_node(const PlannedNode& node, const std::vector<Value>& inputs,
                             const FrameContext& context, void* state = nullptr);

}  // namespace posevote::graph
