// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "graph/awaited.hpp"
#include "graph/planner.hpp"

namespace posevote::graph {
namespace {

void report_cycle(const Plan& plan, const std::vector<bool>& placed,
                  std::vector<Problem>& problems) {
  std::string members;
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (!placed[i]) members += (members.empty() ? "" : ", ") + plan.nodes[i].name;
  const auto first = std::find(placed.begin(), placed.end(), false) - placed.begin();
  const PlannedNode& node = plan.nodes[static_cast<std::size_t>(first)];
  problems.push_back(
      {node.where, node.name, "waits for itself: a cycle through or before " + members});
}

void reorder(Plan& plan, const std::vector<int>& order) {
  std::vector<PlannedNode> nodes;
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[std::size_t(order[i])] = static_cast<int>(i);
    nodes.push_back(std::move(plan.nodes[std::size_t(order[i])]));
  }
  plan.nodes = std::move(nodes);
  for (Stream& stream : plan.streams) {
    if (stream.producer >= 0) stream.producer = place[std::size_t(stream.producer)];
    for (int& consumer : stream.consumers)
      if (consumer >= 0) consumer = place[std::size_t(consumer)];
  }
}

}  // namespace

void detail::order_nodes(Plan& plan, std::vector<Problem>& problems) {
  std::vector<int> order;
  std::vector<bool> placed(plan.nodes.size(), false);
  const auto ready = [&](std::size_t i) {
    const std::vector<int> inputs = awaited(plan.nodes[i]);
    return std::all_of(inputs.begin(), inputs.end(), [&](int s) {
      const int producer = s < 0 ? -1 : plan.streams[std::size_t(s)].producer;
      return producer < 0 || placed[std::size_t(producer)];
    });
  };
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 0; i < plan.nodes.size() && !moved; ++i) {
      if (placed[i] || !ready(i)) continue;
      placed[i] = moved = true;
      order.push_back(static_cast<int>(i));
    }
  }
  if (order.size() < plan.nodes.size()) report_cycle(plan, placed, problems);
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (!placed[i]) order.push_back(static_cast<int>(i));
  reorder(plan, order);
}

}  // namespace posevote::graph
