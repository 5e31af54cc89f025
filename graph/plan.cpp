// SPDX-License-Identifier: BSD-3-Clause
#include "graph/plan.hpp"

namespace posevote::graph {

std::map<std::string, std::map<std::string, std::string>> effective_parameters(const Plan& plan) {
  std::map<std::string, std::map<std::string, std::string>> values;
  for (const PlannedNode& node : plan.nodes) {
    if (node.like) continue;
    for (const ParamSpec& param : node.spec->params)
      values[node.name][param.name] = param.get(node.params.get());
  }
  return values;
}

namespace {

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// Names are unique within a plan only.
std::string id_of(const Plan& plan, int node) {
  return quoted(plan.name + "/" + plan.nodes[std::size_t(node)].name);
}

/// Streams that enter or leave a plan are drawn themselves, those of one name once.
std::string outer(const Stream& stream) { return quoted(stream.name); }

std::string boxes(const Plan& plan) {
  std::string dot =
      "  subgraph " + quoted("cluster_" + plan.name) + " {\n    label=" + quoted(plan.name) + ";\n";
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const PlannedNode& node = plan.nodes[i];
    const std::string type = node.name == node.spec->name ? "" : "\\n(" + node.spec->name + ")";
    dot +=
        "    " + id_of(plan, static_cast<int>(i)) + " [label=" + quoted(node.name + type) + "];\n";
  }
  return dot + "  }\n";
}

std::string edges(const Plan& plan) {
  std::string dot;
  for (const Stream& stream : plan.streams) {
    const std::string from = stream.producer < 0 ? outer(stream) : id_of(plan, stream.producer);
    const std::string label = " [label=" + quoted(stream.name + "\\n" + stream.type.name) + "];\n";
    for (const int consumer : stream.consumers)
      dot.append("  " + from + " -> ")
          .append(consumer < 0 ? outer(stream) : id_of(plan, consumer))
          .append(label);
    if (stream.producer < 0 || &stream == &plan.streams[std::size_t(plan.result)])
      dot += "  " + outer(stream) + " [shape=ellipse];\n";
  }
  return dot;
}

}  // namespace

std::string to_dot(const std::vector<const Plan*>& plans) {
  std::string dot = "digraph posevote {\n  rankdir=LR;\n  node [shape=box];\n";
  for (const Plan* plan : plans)
    if (!plan->nodes.empty()) dot += boxes(*plan) + edges(*plan);
  return dot + "}\n";
}

}  // namespace posevote::graph
