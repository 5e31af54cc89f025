// SPDX-License-Identifier: BSD-3-Clause
#include "graph/variation.hpp"

#include <algorithm>

#include "graph/schema.hpp"

namespace posevote::graph {
namespace {

using Nodes = std::vector<NodeDescription>;

Nodes::iterator find(Nodes& nodes, const std::string& name) {
  return std::find_if(nodes.begin(), nodes.end(),
                      [&name](const NodeDescription& node) { return node.name == name; });
}

/// Where the node stands that is named there; the end and a problem where there is none.
Nodes::iterator find(PipelineDescription& pipeline, const Wire& named,
                     std::vector<Problem>& problems) {
  const auto found = find(pipeline.nodes, named.stream);
  if (found != pipeline.nodes.end()) return found;
  std::vector<std::string> known;
  for (const NodeDescription& node : pipeline.nodes) known.push_back(node.name);
  const std::string near = closest_name(named.stream, known);
  problems.push_back({named.where, named.stream,
                      "no such node in the pipeline that this one extends" +
                          (near.empty() ? "" : ", did you mean '" + near + "'?")});
  return found;
}

/// False, and a problem, where another node has that name.
bool check_free(PipelineDescription& pipeline, const NodeDescription& node,
                std::vector<Problem>& problems) {
  const auto found = find(pipeline.nodes, node.name);
  if (found == pipeline.nodes.end()) return true;
  problems.push_back({node.where, node.name,
                      "the pipeline has a node of that name, in " + to_string(found->where) +
                          "; expected another, or `replace`"});
  return false;
}

}  // namespace

void vary(PipelineDescription& pipeline, const Variation& variation,
          std::vector<Problem>& problems) {
  Nodes& nodes = pipeline.nodes;
  for (const Wire& removed : variation.removed)
    if (const auto place = find(pipeline, removed, problems); place != nodes.end())
      nodes.erase(place);
  for (const auto& [replaced, node] : variation.replaced) {
    const auto place = find(pipeline, replaced, problems);
    if (place == nodes.end()) continue;
    if (node.name == place->name || check_free(pipeline, node, problems)) *place = node;
  }
  for (const auto& [node, beside, before] : variation.inserted) {
    if (!check_free(pipeline, node, problems)) continue;
    auto place = nodes.end();
    if (!beside.stream.empty()) {
      place = find(pipeline, beside, problems);
      if (place != nodes.end() && !before) ++place;
    }
    nodes.insert(place, node);
  }
}

}  // namespace posevote::graph
