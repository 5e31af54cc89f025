// SPDX-License-Identifier: BSD-3-Clause
// Which inputs of a plan's nodes are of the same frame, and which of the frame before
// (graph/previous.hpp).
#pragma once

#include <vector>

#include "graph/plan.hpp"
#include "graph/previous.hpp"

namespace posevote::graph {

/// Whether an input is what its stream held in the frame before (graph/previous.hpp).
inline bool is_previous(const PlannedNode& node, std::size_t input) {
  return node.spec && is_previous(node.spec->inputs[input].type);
}

/// The streams of its inputs that a node waits for within a frame.
inline std::vector<int> awaited(const PlannedNode& node) {
  std::vector<int> streams;
  for (std::size_t i = 0; i < node.inputs.size(); ++i)
    if (!is_previous(node, i)) streams.push_back(node.inputs[i]);
  return streams;
}

/// The nodes that read a stream with the next frame, one for each such input.
inline std::vector<std::size_t> followers_of(const Plan& plan, std::size_t stream) {
  std::vector<std::size_t> followers;
  for (std::size_t node = 0; node < plan.nodes.size(); ++node)
    for (std::size_t i = 0; i < plan.nodes[node].inputs.size(); ++i)
      if (is_previous(plan.nodes[node], i) &&
          plan.nodes[node].inputs[i] == static_cast<int>(stream))
        followers.push_back(node);
  return followers;
}

}  // namespace posevote::graph
