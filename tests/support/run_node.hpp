// SPDX-License-Identifier: BSD-3-Clause
// Runs one node by its registered name, without a graph: run_node<Out>("name", {{"param", "1"}},
// in...)
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "graph/registry.hpp"

namespace posevote::test {

/// Throws std::invalid_argument where a value is not what the node takes.
template <class... In>
void check_inputs(const graph::NodeSpec& spec) {
  const std::vector<graph::StreamType> given{graph::StreamTraits<In>::type()...};
  if (given.size() != spec.inputs.size())
    throw std::invalid_argument(spec.name + " takes " + std::to_string(spec.inputs.size()) +
                                " inputs, not " + std::to_string(given.size()));
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!(given[i] == spec.inputs[i].type))
      throw std::invalid_argument(spec.name + "." + spec.inputs[i].name + " is a " +
                                  spec.inputs[i].type.name + ", not a " + given[i].name);
}

/// All outputs of a node. Throws std::invalid_argument for an unknown node or parameter, inputs of
/// other types than the node's, or a value that is out of range, and whatever the node throws.
template <class... In>
std::vector<graph::Value> run_outputs(const std::string& name,
                                      const std::map<std::string, std::string>& values, In... in) {
  const graph::NodeSpec* spec = graph::find_node(name);
  if (!spec) throw std::invalid_argument("no node is called " + name);
  check_inputs<In...>(*spec);
  const std::shared_ptr<void> params = spec->make_params();
  for (const auto& [key, text] : values) {
    bool known = false;
    for (const graph::ParamSpec& param : spec->params) {
      if (param.name != key) continue;
      known = true;
      if (auto problem = param.set(params.get(), text))
        throw std::invalid_argument(name + "." + key + ": " + *problem);
    }
    if (!known) throw std::invalid_argument(name + " has no parameter " + key);
  }
  const std::vector<graph::Value> inputs{graph::StreamTraits<In>::wrap(std::move(in))...};
  return spec->call(inputs, graph::FrameContext{}, params.get());
}

/// The node's first output.
template <class Out, class... In>
Out run_node(const std::string& name, const std::map<std::string, std::string>& values, In... in) {
  return Out(graph::StreamTraits<Out>::unwrap(run_outputs(name, values, std::move(in)...).at(0)));
}

}  // namespace posevote::test
