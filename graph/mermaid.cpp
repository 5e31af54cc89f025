// SPDX-License-Identifier: BSD-3-Clause
#include "graph/mermaid.hpp"

#include <map>
#include <utility>

#include "graph/awaited.hpp"

namespace posevote::graph {
namespace {

/// Names are unique within a plan only; "end" and the like mean something to Mermaid.
std::string node_name(const Plan& plan, int node) {
  return plan.name + "." + plan.nodes[std::size_t(node)].name;
}

/// Streams that enter or leave a plan are drawn themselves, those of one name once.
std::string stream_node(const Stream& stream) { return "stream." + stream.name; }

std::string subgraph(const Plan& plan) {
  std::string text = "  subgraph " + plan.name + "\n";
  for (std::size_t i = 0; i < plan.nodes.size(); ++i)
    text += "    " + node_name(plan, static_cast<int>(i)) + "[" + plan.nodes[i].name + "]\n";
  return text + "  end\n";
}

/// One arrow between two ends, with the names of all streams that run there.
std::string arrows(const Plan& plan) {
  std::map<std::pair<std::string, std::string>, std::string> labels;
  std::string text;
  for (std::size_t s = 0; s < plan.streams.size(); ++s) {
    const Stream& stream = plan.streams[s];
    const std::string from =
        stream.producer < 0 ? stream_node(stream) : node_name(plan, stream.producer);
    for (const int consumer : stream.consumers) {
      std::string& names =
          labels[{from, consumer < 0 ? stream_node(stream) : node_name(plan, consumer)}];
      names += (names.empty() ? "" : "<br>") + stream.name;
    }
    for (const std::size_t follower : followers_of(plan, s))
      text += "  " + from + " -. " + stream.name + " of the frame before .-> " +
              node_name(plan, static_cast<int>(follower)) + "\n";
    if (stream.producer < 0 || static_cast<int>(s) == plan.result)
      text += "  " + stream_node(stream) + "([" + stream.name + "])\n";
  }
  for (const auto& [ends, names] : labels)
    text += "  " + ends.first + " -->|" + names + "| " + ends.second + "\n";
  return text;
}

}  // namespace

std::string to_mermaid(const std::vector<const Plan*>& plans) {
  std::string text = "flowchart TD\n";
  for (const Plan* plan : plans)
    if (!plan->nodes.empty()) text += subgraph(*plan) + arrows(*plan);
  return text;
}

}  // namespace posevote::graph
