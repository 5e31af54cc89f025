// SPDX-License-Identifier: BSD-3-Clause
#include "graph/yaml_reader.hpp"

#include <algorithm>

#include "graph/did_you_mean.hpp"
#include "graph/yaml_document.hpp"

namespace posevote::graph {

ConfigDescription read_config(const std::string& file, std::vector<Problem>& problems) {
  const detail::Reader reader{file, &problems};
  ConfigDescription config;
  config.where = {file, 1, 1};
  const YAML::Node root = reader.load();
  if (!root.IsDefined()) return config;
  reader.for_each(
      root, "", [&](const std::string& node, const Location& at, const YAML::Node& body) {
        if (node == "pipeline") {
          config.pipeline = reader.scalar(body, at, node);
          config.where = reader.at(body);
          return;
        }
        if (node == "plugins") {
          config.plugins = reader.wires(body, at, node);
          return;
        }
        if (!body.IsMap())
          return reader.report(at, node,
                               "expected the node's parameters, as in {unit: mm}" +
                                   did_you_mean(node, {"pipeline", "plugins"}));
        reader.for_each(
            body, node,
            [&](const std::string& key, const Location& where, const YAML::Node& value) {
              const Setting setting = reader.setting(value, where, node + "." + key);
              if (value.IsScalar() || value.IsSequence())
                config.overrides.push_back({node, key, setting});
            });
      });
  if (config.pipeline.empty())
    reader.report(config.where, "pipeline", "missing: the name of a file in pipelines/");
  return config;
}

Override read_set(const std::string& argument, std::vector<Problem>& problems) {
  const Location where{"--set " + argument, 0, 0};
  const std::size_t equals = argument.find('=');
  const std::size_t dot = argument.substr(0, equals).find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == equals) {
    problems.push_back({where, "", "expected node.parameter=value"});
    return {};
  }
  return {argument.substr(0, dot),
          argument.substr(dot + 1, equals - dot - 1),
          {argument.substr(equals + 1), where}};
}

std::vector<Override> apply_overrides(PipelineDescription& pipeline,
                                      const std::vector<Override>& overrides) {
  std::vector<Override> left;
  int layer = 0;
  for (const Override& change : overrides) {
    ++layer;
    const auto node =
        std::find_if(pipeline.nodes.begin(), pipeline.nodes.end(),
                     [&](const NodeDescription& other) { return other.name == change.node; });
    if (node == pipeline.nodes.end()) {
      left.push_back(change);
    } else if (change.key == "node") {
      node->type = change.setting.text;
      node->where = change.setting.where;
    } else {
      node->settings[change.key] = change.setting;
      node->settings[change.key].layer = layer;
    }
  }
  return left;
}

}  // namespace posevote::graph
