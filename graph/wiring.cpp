// SPDX-License-Identifier: BSD-3-Clause
#include "graph/wiring.hpp"

#include <stdexcept>
#include <vector>

namespace posevote::graph {

const PlannedNode* find_type(const Plan& plan, const std::string& type) {
  for (const PlannedNode& node : plan.nodes)
    if (node.spec->name == type) return &node;
  return nullptr;
}

std::string value_of(const PlannedNode& node, const std::string& param) {
  for (const ParamSpec& each : node.spec->params)
    if (each.name == param) return each.get(node.params.get());
  throw std::out_of_range(node.name + " has no parameter " + param);
}

namespace {

std::string stream_list(const Plan& plan, const std::vector<int>& streams) {
  std::string list;
  for (const int stream : streams)
    list += (list.empty() ? "" : ", ") +
            (stream < 0 ? std::string("-") : plan.streams[std::size_t(stream)].name);
  return list;
}

}  // namespace

std::map<std::string, std::string> wiring(const Plan& plan) {
  std::map<std::string, std::string> nodes;
  for (const PlannedNode& node : plan.nodes)
    nodes[node.name] = node.spec->name + "(" + stream_list(plan, node.inputs) + ") -> " +
                       stream_list(plan, node.outputs);
  return nodes;
}

}  // namespace posevote::graph
