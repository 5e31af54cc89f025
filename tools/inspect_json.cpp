// SPDX-License-Identifier: BSD-3-Clause
#include "tools/inspect_json.hpp"

namespace posevote {

using nlohmann::ordered_json;

namespace {

ordered_json to_json(const std::vector<graph::Port>& ports) {
  ordered_json list = ordered_json::array();
  for (const graph::Port& port : ports)
    list.push_back({{"name", port.name}, {"type", port.type.name}});
  return list;
}

ordered_json to_json(const graph::ParamSpec& param) {
  return {{"name", param.name},
          {"type", param.type},
          {"default", param.default_text},
          {"unit", param.unit},
          {"range", param.constraint.text()},
          {"doc", param.doc},
          {"expert", param.expert}};
}

/// Names of streams; null for an output that nobody reads.
ordered_json streams_of(const graph::Plan& plan, const std::vector<int>& indices) {
  ordered_json names = ordered_json::array();
  for (const int index : indices)
    names.push_back(index < 0 ? ordered_json()
                              : ordered_json(plan.streams[std::size_t(index)].name));
  return names;
}

}  // namespace

ordered_json to_json(const graph::NodeSpec& spec) {
  ordered_json params = ordered_json::array();
  for (const graph::ParamSpec& param : spec.params) params.push_back(to_json(param));
  return {{"name", spec.name},
          {"doc", spec.doc},
          {"inputs", to_json(spec.inputs)},
          {"outputs", to_json(spec.outputs)},
          {"parameters", std::move(params)}};
}

ordered_json to_json(const std::vector<const graph::NodeSpec*>& specs) {
  ordered_json list = ordered_json::array();
  for (const graph::NodeSpec* spec : specs) list.push_back(to_json(*spec));
  return list;
}

ordered_json to_json(const graph::Plan& plan) {
  ordered_json list = ordered_json::array();
  for (const graph::PlannedNode& node : plan.nodes)
    list.push_back({{"name", node.name},
                    {"node", node.spec->name},
                    {"in", streams_of(plan, node.inputs)},
                    {"out", streams_of(plan, node.outputs)}});
  return list;
}

ordered_json to_json(const std::vector<graph::Problem>& problems) {
  ordered_json list = ordered_json::array();
  for (const graph::Problem& problem : problems)
    list.push_back({{"file", problem.where.file},
                    {"line", problem.where.line},
                    {"column", problem.where.column},
                    {"subject", problem.subject},
                    {"problem", problem.text}});
  return list;
}

}  // namespace posevote
