// SPDX-License-Identifier: BSD-3-Clause
#include "graph/plan.hpp"

#include <map>
#include <utility>

#include "graph/awaited.hpp"

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

/// One edge between two ends, with the names of all streams that run there: the type of each comes
/// as the tooltip, which an SVG shows.
std::string edges(const Plan& plan) {
  std::map<std::pair<std::string, std::string>, std::pair<std::string, std::string>> labels;
  std::string dot;
  for (const Stream& stream : plan.streams) {
    const std::string from = stream.producer < 0 ? outer(stream) : id_of(plan, stream.producer);
    for (const int consumer : stream.consumers) {
      auto& [names, types] = labels[{from, consumer < 0 ? outer(stream) : id_of(plan, consumer)}];
      names += (names.empty() ? "" : "\\n") + stream.name;
      types += (types.empty() ? "" : "\\n") + stream.name + ": " + stream.type.name;
    }
    const auto number = static_cast<std::size_t>(&stream - plan.streams.data());
    for (const std::size_t follower : followers_of(plan, number))
      dot += "  " + from + " -> " + id_of(plan, static_cast<int>(follower)) +
             " [label=" + quoted(stream.name + "\\nof the frame before") +
             ", style=dashed, constraint=false];\n";
    if (stream.producer < 0 || &stream == &plan.streams[std::size_t(plan.result)])
      dot += "  " + outer(stream) + " [shape=ellipse];\n";
  }
  for (const auto& [ends, text] : labels)
    dot += "  " + ends.first + " -> " + ends.second + " [label=" + quoted(text.first) +
           ", tooltip=" + quoted(text.second) + "];\n";
  return dot;
}

}  // namespace

std::string to_dot(const std::vector<const Plan*>& plans) {
  std::string dot =
      "digraph posevote {\n  rankdir=TB;\n  nodesep=0.15;\n  ranksep=0.3;\n"
      "  node [shape=box, fontsize=12, margin=\"0.08,0.04\"];\n  edge [fontsize=10];\n";
  for (const Plan* plan : plans)
    if (!plan->nodes.empty()) dot += boxes(*plan) + edges(*plan);
  return dot + "}\n";
}

}  // namespace posevote::graph
