// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "graph/did_you_mean.hpp"
#include "graph/variation.hpp"
#include "graph/yaml_document.hpp"
#include "graph/yaml_reader.hpp"

namespace posevote::graph {
namespace {

namespace fs = std::filesystem;
using detail::Reader;

/// Keys of an entry that say where in a pipeline it stands, not what it is.
using Placing = std::map<std::string, Wire>;

/// `placing` names the keys of that kind that are allowed here, and receives those that are given.
NodeDescription read_node(const Reader& reader, const std::string& name, const Location& where,
                          const YAML::Node& body, Placing* placing = nullptr) {
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
                    } else if (placing && placing->contains(key)) {
                      (*placing)[key] = {"", reader.scalar(value, at, subject), reader.at(value)};
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

void read_replacements(const Reader& reader, const YAML::Node& nodes, const Location& where,
                       Variation& variation) {
  if (!nodes.IsMap()) return reader.report(where, "replace", "expected a map of nodes");
  reader.for_each(nodes, "replace",
                  [&](const std::string& name, const Location& at, const YAML::Node& body) {
                    Placing placing{{"name", {}}};
                    NodeDescription node = read_node(reader, name, at, body, &placing);
                    if (const Wire& renamed = placing["name"]; !renamed.stream.empty()) {
                      if (node.type == node.name) node.type = renamed.stream;
                      node.name = renamed.stream;
                    }
                    variation.replaced.push_back({{"", name, at}, std::move(node)});
                  });
}

void read_insertions(const Reader& reader, const YAML::Node& nodes, const Location& where,
                     Variation& variation) {
  using Place = Variation::Place;
  static const std::map<std::string, Place> places{
      {"after", Place::kAfter}, {"before", Place::kBefore}, {"into", Place::kInto}};
  if (!nodes.IsMap()) return reader.report(where, "insert", "expected a map of nodes");
  reader.for_each(
      nodes, "insert", [&](const std::string& name, const Location& at, const YAML::Node& body) {
        Placing placing;
        for (const auto& place : places) placing[place.first];
        Variation::Insertion insertion;
        insertion.node = read_node(reader, name, at, body, &placing);
        for (const auto& [key, named] : placing) {
          if (named.stream.empty()) continue;
          if (!insertion.at.stream.empty())
            reader.report(at, name, "has more than one of `after`, `before` and `into`");
          insertion.place = places.at(key);
          insertion.at = named;
        }
        variation.inserted.push_back(std::move(insertion));
      });
}

/// A file as it stands, before what it extends is read.
struct Written {
  PipelineDescription pipeline;
  Wire extends;
  Variation variation;
};

void read_key(const Reader& reader, const std::string& key, const Location& at,
              const YAML::Node& value, Written& written) {
  PipelineDescription& pipeline = written.pipeline;
  if (key == "extends") {
    written.extends = {"", reader.scalar(value, at, key), reader.at(value)};
  } else if (key == "models") {
    pipeline.models = reader.scalar(value, at, key);
    pipeline.models_where = reader.at(value);
  } else if (key == "inputs") {
    pipeline.inputs = reader.wires(value, at, key);
    pipeline.inputs_where = reader.at(value);
  } else if (key == "result") {
    pipeline.result = {"", reader.scalar(value, at, key), reader.at(value)};
  } else if (key == "plugins") {
    pipeline.plugins = reader.wires(value, at, key);
  } else if (key == "nodes") {
    read_nodes(reader, value, at, pipeline);
  } else if (key == "replace") {
    read_replacements(reader, value, at, written.variation);
  } else if (key == "insert") {
    read_insertions(reader, value, at, written.variation);
  } else if (key == "remove") {
    written.variation.removed = reader.wires(value, at, key);
  } else {
    const std::vector<std::string> known{"extends", "models",  "inputs", "result", "plugins",
                                         "nodes",   "replace", "insert", "remove"};
    const std::string near = did_you_mean(key, known);
    reader.report(
        at, key,
        "unknown key" + (near.empty() ? ", expected extends, models, inputs, result, plugins, "
                                        "nodes, replace, insert or remove"
                                      : near));
  }
}

Written read_written(const Reader& reader) {
  Written written;
  written.pipeline.name = fs::path(reader.file).stem().string();
  written.pipeline.where = {reader.file, 1, 1};
  const YAML::Node root = reader.load();
  if (!root.IsDefined()) return written;
  reader.for_each(root, "",
                  [&](const std::string& key, const Location& at, const YAML::Node& value) {
                    read_key(reader, key, at, value, written);
                  });
  return written;
}

/// Reads the chain of files that extend each other, from the last one on.
class Flattener {
 public:
  Flattener(std::vector<Problem>& problems, const FindPipeline& find)
      : problems_(problems), find_(find) {}

  PipelineDescription read(const std::string& file) {
    chain_.push_back(file);
    Written written = read_written({file, &problems_});
    PipelineDescription& own = written.pipeline;
    const bool varies = !written.variation.empty();
    if (written.extends.stream.empty()) {
      if (varies)
        report(own.where, "extends", "missing, expected beside replace, insert and remove");
      return own;
    }
    if (!own.nodes.empty())
      report(own.where, "nodes", "stand beside `extends`, expected replace, insert and remove");
    const std::string base = find_base(written.extends);
    if (base.empty()) return own;
    PipelineDescription flat = read(base);
    if (flat.nodes.empty()) return flat;  // reported
    vary(flat, written.variation, problems_);
    flat.name = own.name;
    flat.where = own.where;
    if (!own.models.empty())
      std::tie(flat.models, flat.models_where) = {own.models, own.models_where};
    if (!own.inputs.empty())
      std::tie(flat.inputs, flat.inputs_where) = {own.inputs, own.inputs_where};
    if (!own.result.stream.empty()) flat.result = own.result;
    flat.plugins.insert(flat.plugins.end(), own.plugins.begin(), own.plugins.end());
    return flat;
  }

 private:
  void report(const Location& where, std::string subject, std::string text) {
    problems_.push_back({where, std::move(subject), std::move(text)});
  }

  /// The file of what a pipeline extends; "" and a problem where there is none.
  std::string find_base(const Wire& extends) {
    std::string base;
    try {
      base = find_(extends.stream, extends.where.file);
    } catch (const std::invalid_argument& error) {
      report(extends.where, "extends", error.what());
      return "";
    }
    const auto is_base = [&base](const std::string& file) {
      std::error_code ignored;
      return file == base || fs::equivalent(file, base, ignored);
    };
    if (std::none_of(chain_.begin(), chain_.end(), is_base)) return base;
    std::string names;
    for (const std::string& file : chain_) names += fs::path(file).stem().string() + " -> ";
    report(extends.where, "extends", "goes round in a circle: " + names + extends.stream);
    return "";
  }

  std::vector<Problem>& problems_;
  const FindPipeline& find_;
  std::vector<std::string> chain_;
};

}  // namespace

std::string beside(const std::string& name, const std::string& from) {
  const fs::path file = fs::path(from).parent_path() / (name + ".yaml");
  if (fs::exists(file)) return file.string();
  throw std::invalid_argument("no pipeline is called '" + name + "', expected " + name +
                              ".yaml beside this one");
}

PipelineDescription read_pipeline(const std::string& file, std::vector<Problem>& problems,
                                  const FindPipeline& find) {
  const std::size_t before = problems.size();
  PipelineDescription pipeline = Flattener(problems, find).read(file);
  if (pipeline.nodes.empty() && problems.size() > before) return pipeline;  // could not be read
  const auto missing = [&](const char* subject, const char* text) {
    problems.push_back({pipeline.where, subject, text});
  };
  if (pipeline.nodes.empty()) missing("nodes", "the pipeline has no nodes");
  if (pipeline.inputs.empty()) missing("inputs", "missing: the streams that come with each frame");
  if (pipeline.result.stream.empty())
    missing("result", "missing: the stream that each frame leaves with");
  return pipeline;
}

bool is_pipeline(const std::string& file) {
  try {
    std::vector<Problem> ignored;
    const YAML::Node root = Reader{file, &ignored}.load();
    return root.IsDefined() && (root["nodes"].IsDefined() || root["extends"].IsDefined());
  } catch (const std::exception&) {
    return false;  // read_config reports it, with the place
  }
}

}  // namespace posevote::graph
