// SPDX-License-Identifier: BSD-3-Clause
#include "graph/description.hpp"

#include <algorithm>

namespace posevote::graph {
namespace {

const NodeDescription* find(const PipelineDescription* pipeline, const std::string& name) {
  if (!pipeline) return nullptr;
  for (const NodeDescription& node : pipeline->nodes)
    if (node.name == name && node.like.empty()) return &node;
  return nullptr;
}

}  // namespace

void resolve_likes(PipelineDescription& pipeline, const PipelineDescription* models,
                   std::vector<Problem>& problems) {
  for (NodeDescription& node : pipeline.nodes) {
    if (node.like.empty()) continue;
    for (const auto& [key, setting] : node.settings)
      problems.push_back(
          {setting.where, node.name + "." + key,
           "cannot be set, expected " + node.like + "." + key + ": the node is like " + node.like});
    const NodeDescription* other = find(&pipeline, node.like);
    if (!other) other = find(models, node.like);
    if (other) {
      node.type = other->type;
      node.settings = other->settings;
    } else {
      problems.push_back(
          {node.where, node.name,
           "is like '" + node.like + "', expected a node with parameters of its own"});
    }
  }
}

}  // namespace posevote::graph
