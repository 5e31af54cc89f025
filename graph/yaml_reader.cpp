// SPDX-License-Identifier: BSD-3-Clause
#include "graph/yaml_reader.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "graph/schema.hpp"

namespace posevote::graph {
namespace {

/// "node.param"; the key alone where there is no node.
std::string dotted(const std::string& subject, const std::string& key) {
  return subject.empty() ? key : subject + "." + key;
}

/// One YAML file, its name for messages, and where problems go.
struct Reader {
  std::string file;
  std::vector<Problem>* problems;

  Location at(const YAML::Mark& mark) const { return {file, mark.line + 1, mark.column + 1}; }
  Location at(const YAML::Node& node) const { return at(node.Mark()); }
  void report(const Location& where, std::string subject, std::string text) const {
    problems->push_back({where, std::move(subject), std::move(text)});
  }

  YAML::Node load() const {
    try {
      if (std::filesystem::is_directory(file)) {  // yaml-cpp would leak what it began to read
        report({file, 0, 0}, "", "is a folder, expected a YAML file");
        return YAML::Node(YAML::NodeType::Undefined);
      }
      const std::vector<YAML::Node> documents = YAML::LoadAllFromFile(file);
      for (std::size_t i = 1; i < documents.size(); ++i)
        report(at(documents[i]), "", "starts another YAML document; only the first would count");
      if (!documents.empty() && documents[0].IsMap()) return documents[0];
      report({file, 1, 1}, "", "expected a map of keys, as in `pipeline: recognize`");
    } catch (const YAML::BadFile&) {
      report({file, 0, 0}, "", "cannot be read: no such file?");
    } catch (const YAML::Exception& error) {
      report(at(error.mark), "", "is not valid YAML: " + error.msg);
    }
    return YAML::Node(YAML::NodeType::Undefined);
  }

  /// Calls visit(key, key's place, value) for each entry; reports keys given twice (yaml-cpp itself
  /// would silently take the first) and keys that are no plain words.
  void for_each(const YAML::Node& map, const std::string& subject,
                const std::function<void(const std::string&, const Location&, const YAML::Node&)>&
                    visit) const {
    std::map<std::string, Location> seen;
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) {
        report(at(entry.first), subject, "a key must be a plain word");
        continue;
      }
      const std::string key = entry.first.Scalar();
      const auto [first, is_new] = seen.emplace(key, at(entry.first));
      if (is_new)
        visit(key, first->second, entry.second);
      else
        report(at(entry.first), dotted(subject, key),
               "given twice, first in line " + std::to_string(first->second.line));
    }
  }

  std::string scalar(const YAML::Node& node, const Location& key,
                     const std::string& subject) const {
    if (node.IsScalar()) return node.Scalar();
    report(node.IsNull() ? key : at(node), subject, "expected one plain value");
    return "";
  }

  /// A parameter's value: a plain one, or a list of them.
  Setting setting(const YAML::Node& node, const Location& key, const std::string& subject) const {
    if (!node.IsSequence())
      return {scalar(node, key, subject), node.IsScalar() ? at(node) : key, false};
    std::vector<std::string> items;
    for (const auto& item : node) {
      items.push_back(scalar(item, key, subject));
      if (items.back().find(',') != std::string::npos)
        report(at(item), subject, "'" + items.back() + "': an item of a list holds no comma");
    }
    return {join_list(items), at(node), true};
  }

  /// `a`, `[a, b]` or `{port: a}`.
  std::vector<Wire> wires(const YAML::Node& node, const Location& key,
                          const std::string& subject) const {
    std::vector<Wire> found;
    if (node.IsMap()) {
      for_each(node, subject,
               [&](const std::string& port, const Location& where, const YAML::Node& value) {
                 const std::string stream = scalar(value, where, subject + "." + port);
                 if (!stream.empty()) found.push_back({port, stream, at(value)});
               });
    } else if (node.IsSequence()) {
      for (const auto& item : node) {
        const std::string stream = scalar(item, key, subject);
        if (!stream.empty()) found.push_back({"", stream, at(item)});
      }
    } else if (const std::string stream = scalar(node, key, subject); !stream.empty()) {
      found.push_back({"", stream, at(node)});
    }
    return found;
  }
};

NodeDescription read_node(const Reader& reader, const std::string& name, const Location& where,
                          const YAML::Node& body) {
  NodeDescription node{name, name, "", where, {}, {}, {}};
  if (!body.IsMap()) {
    reader.report(where, name, "expected {in: STREAM, out: STREAM, parameter: value ...}");
    return node;
  }
  bool has_type = false;
  reader.for_each(body, name,
                  [&](const std::string& key, const Location& at, const YAML::Node& value) {
                    const std::string subject = name + "." + key;
                    if (key == "in") {
                      node.inputs = reader.wires(value, at, subject);
                    } else if (key == "out") {
                      node.outputs = reader.wires(value, at, subject);
                    } else if (key == "node") {
                      node.type = reader.scalar(value, at, subject);
                      has_type = true;
                    } else if (key == "like") {
                      node.like = reader.scalar(value, at, subject);
                    } else {
                      node.settings[key] = reader.setting(value, at, subject);
                    }
                  });
  if (has_type && !node.like.empty())
    reader.report(where, name, "has both `node` and `like`, expected one of them");
  return node;
}

void read_nodes(const Reader& reader, const YAML::Node& nodes, const Location& where,
                PipelineDescription& pipeline) {
  if (!nodes.IsMap()) return reader.report(where, "nodes", "expected a map of nodes");
  reader.for_each(nodes, "",
                  [&](const std::string& name, const Location& at, const YAML::Node& body) {
                    pipeline.nodes.push_back(read_node(reader, name, at, body));
                  });
}

void unknown_key(const Reader& reader, const Location& where, const std::string& key,
                 const std::vector<std::string>& known) {
  const std::string near = closest_name(key, known);
  reader.report(where, key,
                "unknown key, " + (near.empty() ? "expected models, inputs, result or nodes"
                                                : "did you mean '" + near + "'?"));
}

}  // namespace

PipelineDescription read_pipeline(const std::string& file, std::vector<Problem>& problems) {
  const Reader reader{file, &problems};
  PipelineDescription pipeline;
  pipeline.name = std::filesystem::path(file).stem().string();
  pipeline.where = {file, 1, 1};
  const YAML::Node root = reader.load();
  if (!root.IsDefined()) return pipeline;
  reader.for_each(root, "",
                  [&](const std::string& key, const Location& at, const YAML::Node& value) {
                    if (key == "models") {
                      pipeline.models = reader.scalar(value, at, key);
                      pipeline.models_where = reader.at(value);
                    } else if (key == "inputs") {
                      pipeline.inputs = reader.wires(value, at, key);
                      pipeline.inputs_where = reader.at(value);
                    } else if (key == "result") {
                      pipeline.result = {"", reader.scalar(value, at, key), reader.at(value)};
                    } else if (key == "nodes") {
                      read_nodes(reader, value, at, pipeline);
                    } else {
                      unknown_key(reader, at, key, {"models", "inputs", "result", "nodes"});
                    }
                  });
  if (pipeline.nodes.empty()) reader.report(pipeline.where, "nodes", "the pipeline has no nodes");
  if (pipeline.inputs.empty())
    reader.report(pipeline.where, "inputs", "missing: the streams that come with each frame");
  if (pipeline.result.stream.empty())
    reader.report(pipeline.where, "result", "missing: the stream that each frame leaves with");
  return pipeline;
}

ConfigDescription read_config(const std::string& file, std::vector<Problem>& problems) {
  const Reader reader{file, &problems};
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
        if (!body.IsMap())
          return reader.report(at, node, "expected the node's parameters, as in {unit: mm}");
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

bool is_pipeline(const std::string& file) {
  try {
    std::vector<Problem> ignored;
    const YAML::Node root = Reader{file, &ignored}.load();
    return root.IsDefined() && root["nodes"].IsDefined();
  } catch (const std::exception&) {
    return false;  // read_config reports it, with the place
  }
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
