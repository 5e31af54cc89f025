// SPDX-License-Identifier: BSD-3-Clause
// One frame through a plan, with all values kept, so that a changed node is run again together with
// what depends on it and nothing else.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/flow.hpp"

namespace posevote::ablation {

class Replay {
 public:
  /// Runs all nodes that the plan's result depends on, or `stream`, a number in the plan.
  /// `constants`: from fold_constants; `inputs`: in the plan's order; `context`: what the nodes know
  /// of the frame. Keeps a reference to the plan. Throws what a node throws.
  Replay(const graph::Plan& plan, const graph::Constants& constants,
         const std::vector<graph::Value>& inputs, graph::FrameContext context = {},
         std::optional<int> stream = std::nullopt);

  /// The result if the node of that name were this one. It and those behind it read these values
  /// `instead`, by stream; other nodes are not run again for them.
  graph::Value rerun(const graph::PlannedNode& changed,
                     const std::map<std::string, graph::Value>& instead = {}) const;

  /// Throws std::invalid_argument for a stream that there is not.
  const graph::Value& value(const std::string& stream) const;

 private:
  const graph::Plan& plan_;
  graph::FrameContext context_;
  std::vector<bool> needed_;          ///< per node: the result depends on it
  std::vector<graph::Value> values_;  ///< per stream
};

/// The number of the stream of that name. Throws std::invalid_argument where there is none.
std::size_t number_of(const graph::Plan& plan, const std::string& stream);

/// Per node: whether the stream of that number depends on it within a frame.
std::vector<bool> nodes_before(const graph::Plan& plan, int stream);

/// The node of that name. Throws std::invalid_argument where there is none.
const graph::PlannedNode& find_planned(const graph::Plan& plan, const std::string& name);

}  // namespace posevote::ablation
