// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ablation/replay.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "graph/awaited.hpp"
#include "graph/node_call.hpp"

namespace posevote::ablation {
namespace {

void call(const graph::PlannedNode& node, const graph::FrameContext& context,
          std::vector<graph::Value>& values) {
  std::vector<graph::Value> inputs;
  for (std::size_t i = 0; i < node.inputs.size(); ++i)
    inputs.push_back(graph::is_previous(node, i) ? nullptr : values[std::size_t(node.inputs[i])]);
  std::vector<graph::Value> made = graph::call_node(node, inputs, context);
  for (std::size_t i = 0; i < made.size(); ++i)
    if (node.outputs[i] >= 0) values[std::size_t(node.outputs[i])] = std::move(made[i]);
}

}  // namespace

std::size_t number_of(const graph::Plan& plan, const std::string& stream) {
  for (std::size_t i = 0; i < plan.streams.size(); ++i)
    if (plan.streams[i].name == stream) return i;
  throw std::invalid_argument(plan.name + ": has no stream '" + stream + "'");
}

std::vector<bool> nodes_before(const graph::Plan& plan, int result) {
  std::vector<bool> needed(plan.nodes.size(), false);
  std::vector<int> open{result};
  while (!open.empty()) {
    const int producer = plan.streams[std::size_t(open.back())].producer;
    open.pop_back();
    if (producer < 0 || needed[std::size_t(producer)]) continue;
    needed[std::size_t(producer)] = true;
    const std::vector<int> inputs = graph::awaited(plan.nodes[std::size_t(producer)]);
    open.insert(open.end(), inputs.begin(), inputs.end());
  }
  return needed;
}

const graph::PlannedNode& find_planned(const graph::Plan& plan, const std::string& name) {
  for (const graph::PlannedNode& node : plan.nodes)
    if (node.name == name) return node;
  throw std::invalid_argument(plan.name + ": has no node '" + name + "'");
}

Replay::Replay(const graph::Plan& plan, const graph::Constants& constants,
               const std::vector<graph::Value>& inputs, graph::FrameContext context,
               std::optional<int> stream)
    : plan_(plan),
      context_(std::move(context)),
      needed_(nodes_before(plan, stream.value_or(plan.result))),
      values_(plan.streams.size()) {
  for (const auto& [name, value] : constants) values_[number_of(plan, name)] = value.value;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    values_[std::size_t(plan.inputs.at(i))] = inputs[i];
  for (std::size_t i = 0; i < plan.nodes.size(); ++i)
    if (needed_[i] && !plan.nodes[i].constant) call(plan.nodes[i], context_, values_);
}

const graph::Value& Replay::value(const std::string& stream) const {
  return values_[number_of(plan_, stream)];
}

graph::Value Replay::rerun(const graph::PlannedNode& changed,
                           const std::map<std::string, graph::Value>& instead) const {
  std::vector<graph::Value> values = values_;
  for (const auto& [stream, value] : instead) values[number_of(plan_, stream)] = value;
  std::vector<bool> differs(values.size(), false);
  for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
    const bool is_changed = plan_.nodes[i].name == changed.name;
    const graph::PlannedNode& node = is_changed ? changed : plan_.nodes[i];
    const bool depends = std::any_of(node.inputs.begin(), node.inputs.end(),
                                     [&](int input) { return differs[std::size_t(input)]; });
    if (!needed_[i] || !(is_changed || depends)) continue;
    call(node, context_, values);
    for (const int output : node.outputs)
      if (output >= 0) differs[std::size_t(output)] = true;
  }
  return values[std::size_t(plan_.result)];
}

}  // namespace posevote::ablation
