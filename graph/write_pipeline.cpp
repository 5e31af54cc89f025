// SPDX-License-Identifier: BSD-3-Clause
#include <yaml-cpp/yaml.h>

#include "graph/plugin.hpp"
#include "graph/schema.hpp"
#include "graph/yaml_reader.hpp"

namespace posevote::graph {
namespace {

/// As it was written: `a`, `[a, b]` or `{port: a}`.
void emit(YAML::Emitter& out, const std::vector<Wire>& wires) {
  if (wires.size() == 1 && wires[0].port.empty()) {
    out << wires[0].stream;
  } else if (!wires.empty() && !wires[0].port.empty()) {
    out << YAML::Flow << YAML::BeginMap;
    for (const Wire& wire : wires) out << YAML::Key << wire.port << YAML::Value << wire.stream;
    out << YAML::EndMap;
  } else {
    out << YAML::Flow << YAML::BeginSeq;
    for (const Wire& wire : wires) out << wire.stream;
    out << YAML::EndSeq;
  }
}

void emit(YAML::Emitter& out, const Setting& setting) {
  if (!setting.list) {
    out << setting.text;
    return;
  }
  out << YAML::Flow << YAML::BeginSeq;
  for (const std::string& item : split_list(setting.text).value_or(std::vector<std::string>{}))
    out << item;
  out << YAML::EndSeq;
}

void emit(YAML::Emitter& out, const NodeDescription& node) {
  out << YAML::Flow << YAML::BeginMap;
  if (!node.like.empty())
    out << YAML::Key << "like" << YAML::Value << node.like;
  else if (node.type != node.name)
    out << YAML::Key << "node" << YAML::Value << node.type;
  if (!node.inputs.empty()) {
    out << YAML::Key << "in" << YAML::Value;
    emit(out, node.inputs);
  }
  if (!node.outputs.empty()) {
    out << YAML::Key << "out" << YAML::Value;
    emit(out, node.outputs);
  }
  for (const auto& [key, setting] : node.settings) {
    out << YAML::Key << key << YAML::Value;
    emit(out, setting);
  }
  out << YAML::EndMap;
}

}  // namespace

std::string to_yaml(const PipelineDescription& pipeline) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  if (!pipeline.models.empty()) out << YAML::Key << "models" << YAML::Value << pipeline.models;
  if (!pipeline.plugins.empty()) {
    out << YAML::Key << "plugins" << YAML::Value << YAML::Flow << YAML::BeginSeq;
    for (const Wire& plugin : pipeline.plugins) out << file_of(plugin);
    out << YAML::EndSeq;
  }
  out << YAML::Key << "inputs" << YAML::Value;
  emit(out, pipeline.inputs);
  out << YAML::Key << "result" << YAML::Value << pipeline.result.stream;
  out << YAML::Key << "nodes" << YAML::Value << YAML::BeginMap;
  for (const NodeDescription& node : pipeline.nodes) {
    out << YAML::Key << node.name << YAML::Value;
    emit(out, node);
  }
  out << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace posevote::graph
