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

std::string to_dot(const Plan& plan) {
  std::string dot = "digraph \"" + plan.name + "\" {\n  rankdir=LR;\n  node [shape=box];\n";
  const auto edge = [](const std::string& from, const std::string& to, const Stream& stream) {
    return "  \"" + from + "\" -> \"" + to + "\" [label=\"" + stream.name + "\\n" +
           stream.type.name + "\"];\n";
  };
  for (const PlannedNode& node : plan.nodes)
    if (node.name != node.spec->name)
      dot += "  \"" + node.name + "\" [label=\"" + node.name + "\\n(" + node.spec->name + ")\"];\n";
  for (const Stream& stream : plan.streams) {
    const std::string from =
        stream.producer < 0 ? stream.name : plan.nodes[std::size_t(stream.producer)].name;
    if (stream.producer < 0)
      dot +=
          "  \"" + from + "\" [shape=ellipse" + (stream.constant ? ", style=dashed" : "") + "];\n";
    for (const int consumer : stream.consumers)
      dot += edge(from, consumer < 0 ? "result" : plan.nodes[std::size_t(consumer)].name, stream);
  }
  return dot + "  \"result\" [shape=ellipse];\n}\n";
}

}  // namespace posevote::graph
