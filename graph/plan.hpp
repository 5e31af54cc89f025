// SPDX-License-Identifier: BSD-3-Clause
// A checked pipeline: nodes in an order in which they can run, parameters set, streams resolved.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "graph/description.hpp"
#include "graph/registry.hpp"

namespace posevote::graph {

/// A stream of a plan. Producer -1: it comes with the frame, or is a constant of the run.
struct Stream {
  std::string name;
  StreamType type;
  int producer = -1;             ///< index into Plan::nodes
  bool constant = false;         ///< the same value for every frame
  std::vector<int> consumers{};  ///< indices into Plan::nodes
};

/// A node of a plan.
struct PlannedNode {
  std::string name;
  const NodeSpec* spec = nullptr;
  std::shared_ptr<void> params;
  std::vector<int> inputs;   ///< streams, in the order of the node type's ports
  std::vector<bool> lift;    ///< per input: one slot of a PerObject stream at a time
  std::vector<int> outputs;  ///< streams, in the order of the ports; -1 where nobody wants one
  bool lifted = false;       ///< runs once per object
  bool like = false;         ///< has type and parameters of another node
  bool constant = false;     ///< all inputs are constants: runs once, before the first frame
  Location where;
};

struct Plan {
  std::string name;
  std::vector<PlannedNode> nodes;  ///< in an order in which they can run
  std::vector<Stream> streams;
  std::vector<int> inputs;  ///< streams that come with each frame
  int result = -1;          ///< stream that a frame leaves with
};

/// What the program that runs a pipeline hands in and takes out: the types of both ends.
struct PlanEnds {
  std::string role;                ///< for messages: "a pipeline for scans"
  std::vector<StreamType> inputs;  ///< what comes with each frame, in the order of `inputs`
  StreamType result;               ///< what a frame leaves with
  std::map<std::string, StreamType> constants;  ///< what it provides once for the whole run
};

/// Checks everything there is to check without data and returns the plan. What is wrong is added to
/// `problems`: unknown node, parameter or stream, wrong type, out of range, unconnected or doubly
/// produced stream, type mismatch within and at the ends, cycle, output that nobody reads. With
/// problems the plan is not to be used.
Plan make_plan(const PipelineDescription& description, const PlanEnds& ends,
               std::vector<Problem>& problems);

/// "describe_scene.radius" -> value, for every parameter of every node that has its own.
std::map<std::string, std::map<std::string, std::string>> effective_parameters(const Plan& plan);

/// The wiring of plans in one drawing (Graphviz DOT): a box each, joined where the result of one is
/// a constant of another. Plans without nodes are left out.
std::string to_dot(const std::vector<const Plan*>& plans);

}  // namespace posevote::graph
