// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/shared_stages.hpp"

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "graph/awaited.hpp"
#include "graph/node_call.hpp"
#include "tools/ablation/replay.hpp"

namespace posevote::sweep {
namespace {

void check_stands_alone(const graph::PlannedNode& node) {
  bool carries = static_cast<bool>(node.spec->make_state);
  for (std::size_t i = 0; i < node.inputs.size(); ++i) carries |= graph::is_previous(node, i);
  if (carries)
    throw std::invalid_argument(node.name +
                                ": carries something from frame to frame; expected a pipeline "
                                "whose frames stand alone, as --pipeline recognize");
}

std::string address_of(const graph::Value& value) {
  return "constant " + std::to_string(reinterpret_cast<std::uintptr_t>(value.get()));
}

}  // namespace

std::size_t SharedStages::id_of(const std::string& text) {
  return ids_.emplace(text, ids_.size()).first->second;
}

std::size_t SharedStages::id_of(const graph::PlannedNode& node,
                                const std::vector<std::size_t>& streams) {
  std::string text = node.spec->name;
  for (const graph::ParamSpec& param : node.spec->params)
    text += "\n" + param.name + "=" + param.get(node.params.get());
  for (std::size_t i = 0; i < node.inputs.size(); ++i)
    text += (node.lift[i] ? "\neach of " : "\n") +
            std::to_string(streams[static_cast<std::size_t>(node.inputs[i])]);
  return id_of(text);
}

SharedStages::SharedStages(std::vector<Variant> variants) {
  Cache folded;
  for (const Variant& variant : variants) ways_.push_back(prepare(variant, folded));
  for (std::size_t i = 0; i < ways_.size(); ++i)
    for (const Step& step : ways_[i].steps) last_[step.id] = i;
}

SharedStages::Way SharedStages::prepare(const Variant& variant, Cache& folded) {
  const graph::Plan& plan = *variant.plan;
  Way way{&plan, std::vector<graph::Value>(plan.streams.size()), {}, 0};
  std::vector<std::size_t> streams(plan.streams.size());  // their ids
  for (std::size_t i = 0; i < plan.inputs.size(); ++i)
    streams[static_cast<std::size_t>(plan.inputs[i])] = id_of("input " + std::to_string(i));
  for (const auto& [name, value] : variant.constants) {
    const std::size_t stream = ablation::number_of(plan, name);
    way.constants[stream] = value;
    streams[stream] = id_of(address_of(value));
  }
  const std::vector<bool> needed = ablation::nodes_before(plan, plan.result);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const graph::PlannedNode& node = plan.nodes[i];
    if (!needed[i]) continue;
    check_stands_alone(node);
    const Step step{&node, id_of(node, streams)};
    for (std::size_t port = 0; port < node.outputs.size(); ++port)
      if (node.outputs[port] >= 0)
        streams[static_cast<std::size_t>(node.outputs[port])] =
            id_of("output " + std::to_string(port) + " of " + std::to_string(step.id));
    if (!node.constant) {
      way.steps.push_back(step);
    } else if (const Made& made = make(step, {}, way.constants, folded); made.failure) {
      throw std::runtime_error(*made.failure);
    }
  }
  way.answer = streams[static_cast<std::size_t>(plan.result)];
  return way;
}

const SharedStages::Made& SharedStages::make(const Step& step, const graph::FrameContext& context,
                                             std::vector<graph::Value>& values, Cache& cache) {
  const graph::PlannedNode& node = *step.node;
  const auto [place, is_new] = cache.try_emplace(step.id);
  Made& made = place->second;
  ++calls_[node.name].asked;
  if (is_new) {
    ++calls_[node.name].made;
    std::vector<graph::Value> inputs;
    for (const int input : node.inputs) inputs.push_back(values[static_cast<std::size_t>(input)]);
    const auto begin = std::chrono::steady_clock::now();
    try {
      made.values = graph::call_node(node, inputs, context);
    } catch (const graph::EndOfRun&) {
      throw;
    } catch (const std::exception& error) {
      made.failure = node.name + ": " + graph::reason_of(error);
    }
    made.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  for (std::size_t port = 0; port < made.values.size(); ++port)
    if (node.outputs[port] >= 0)
      values[static_cast<std::size_t>(node.outputs[port])] = made.values[port];
  return made;
}

SharedStages::Outcome SharedStages::follow(const Way& way, const std::vector<graph::Value>& inputs,
                                           const graph::FrameContext& context, Cache& cache) {
  Outcome outcome;
  std::vector<graph::Value> values = way.constants;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    values[static_cast<std::size_t>(way.plan->inputs.at(i))] = inputs[i];
  for (const Step& step : way.steps) {
    const Made& made = make(step, context, values, cache);
    outcome.seconds += made.seconds;
    outcome.failure = made.failure;
    if (outcome.failure) return outcome;
  }
  outcome.result = values[static_cast<std::size_t>(way.plan->result)];
  return outcome;
}

std::vector<SharedStages::Outcome> SharedStages::run(const std::vector<graph::Value>& inputs,
                                                     const graph::FrameContext& context) {
  Cache cache;
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    outcomes.push_back(follow(ways_[i], inputs, context, cache));
    std::erase_if(cache, [&](const auto& made) { return last_.at(made.first) == i; });
  }
  return outcomes;
}

}  // namespace posevote::sweep
