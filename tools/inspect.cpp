// SPDX-License-Identifier: BSD-3-Clause
// Commands that look and do not run: check, nodes, graph; and the reference of nodes.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>

#include "graph/plugin.hpp"
#include "graph/registry.hpp"
#include "graph/yaml_reader.hpp"
#include "pipelines/configuration.hpp"
#include "tools/commands.hpp"
#include "tools/inspect_json.hpp"
#include "tools/json_answer.hpp"

namespace posevote {
namespace {

using graph::NodeSpec;
using graph::ParamSpec;
using graph::Port;

/// Folders of nodes in the order of the reference; others come after them.
const std::vector<std::string> kWayOfTheData{"load",    "prepare",  "describe", "match", "vote",
                                             "segment", "baseline", "train",    "write"};

/// "prepare" for nodes/prepare/downsample_voxels.cpp.
std::string folder_of(const NodeSpec& spec) {
  return std::filesystem::path(spec.source).parent_path().filename().string();
}

std::string ports(const NodeSpec& spec) {
  std::string text;
  for (const Port& port : spec.inputs)
    text += (text.empty() ? "" : ", ") + port.name + ": " + port.type.name;
  text = "(" + text + ")";
  for (const Port& port : spec.outputs)
    text += (&port == &spec.outputs[0] ? " -> " : ", ") + port.name + ": " + port.type.name;
  return text;
}

/// Those for experts, or the others; in the order of their registration.
std::vector<ParamSpec> parameters(const NodeSpec& spec, bool expert) {
  std::vector<ParamSpec> chosen = spec.params;
  std::erase_if(chosen, [expert](const ParamSpec& param) { return param.expert != expert; });
  return chosen;
}

/// "name", or "[a, b]" for more than one.
std::string streams(const std::vector<std::string>& names) {
  return names.size() == 1 ? names[0] : graph::join_list(names);
}

std::string quoted_if_empty(const std::string& text) { return text.empty() ? "''" : text; }

std::string range(const ParamSpec& param) {
  return param.constraint.text().empty() ? "any" : param.constraint.text();
}

void print_parameters(const std::vector<ParamSpec>& params) {
  for (const ParamSpec& param : params)
    std::cout << "  " << param.name << ": " << param.type << " = "
              << quoted_if_empty(param.default_text)
              << (param.unit.empty() ? "" : " [" + param.unit + "]") << ", " << range(param)
              << "\n      " << param.doc << "\n";
  if (!params.empty()) std::cout << "\n";
}

void print_node(const NodeSpec& spec) {
  std::cout << spec.name << ' ' << ports(spec) << "\n  " << spec.doc << "\n\n";
  print_parameters(parameters(spec, false));
  const std::vector<ParamSpec> expert = parameters(spec, true);
  if (!expert.empty()) std::cout << "  For experts:\n\n";
  print_parameters(expert);
  std::cout << "  " << example(spec) << "\n";
}

std::string table(const std::vector<ParamSpec>& params) {
  if (params.empty()) return "";
  std::string text = "| parameter | type | default | unit | range | |\n|---|---|---|---|---|---|\n";
  for (const ParamSpec& param : params)
    text += "| `" + param.name + "` | " + param.type + " | " + param.default_text + " | " +
            param.unit + " | " + range(param) + " | " + param.doc + " |\n";
  return text + "\n";
}

/// The reference's section of one node.
std::string section(const NodeSpec& spec) {
  const std::vector<ParamSpec> expert = parameters(spec, true);
  return "### " + spec.name + "\n\n" + spec.doc + "\n\n`" + ports(spec) + "`\n\n" +
         table(parameters(spec, false)) + (expert.empty() ? "" : "For experts:\n\n") +
         table(expert) + "```yaml\n" + example(spec) + "\n```\n\n";
}

}  // namespace

std::string example(const NodeSpec& spec) {
  std::vector<std::string> in, out;
  for (const Port& port : spec.inputs) in.push_back(port.name);
  for (const Port& port : spec.outputs) {
    const bool is_taken = std::find(in.begin(), in.end(), port.name) != in.end();
    out.push_back((is_taken ? "new_" : "") + port.name);
  }
  std::string text = spec.name + ": {in: " + streams(in);
  if (!out.empty()) text += ", out: " + streams(out);
  for (const ParamSpec& param : parameters(spec, false))
    text += ", " + param.name + ": " + quoted_if_empty(param.default_text);
  return text + "}";
}

namespace {

/// The problems are the answer that a program wants.
int check_for_programs(const InspectCommand& command) {
  const JsonAnswer answer(true);
  std::vector<graph::Problem> problems;
  try {
    load_configuration(command.config, command.set, {}, command.pipeline);
  } catch (const graph::ConfigError& error) {
    problems = error.problems();
  } catch (const std::invalid_argument& error) {
    graph::Problem& only = problems.emplace_back();
    only.where.file = command.config;
    only.text = error.what();
  }
  answer.give({{"config", command.config}, {"problems", to_json(problems)}});
  return problems.empty() ? 0 : 2;
}

}  // namespace

int check_command(const InspectCommand& command) {
  if (command.json) return check_for_programs(command);
  const Configuration configuration =
      load_configuration(command.config, command.set, {}, command.pipeline);
  if (command.flat) {
    std::cout << graph::to_yaml(configuration.wiring);
    return 0;
  }
  const std::size_t scenes = configuration.scenes.nodes.size();
  std::cout << command.config << ": fine, "
            << (scenes > 0 ? std::to_string(scenes) + " nodes a scan and " : "")
            << configuration.models.nodes.size() << " nodes for the models\n";
  return 0;
}

int nodes_command(const std::string& name, bool json) {
  const JsonAnswer answer(json);
  if (name.empty() && json) return answer.give(to_json(graph::all_nodes())), 0;
  if (name.empty()) {
    for (const NodeSpec* spec : graph::all_nodes())
      std::printf("%-22s %s\n", spec->name.c_str(), spec->doc.c_str());
    return 0;
  }
  const NodeSpec* spec = graph::find_node(name);
  if (spec && json) return answer.give(to_json(*spec)), 0;
  if (spec) return print_node(*spec), 0;
  throw std::invalid_argument(graph::unknown_node(name));
}

int graph_command(const InspectCommand& command) {
  const JsonAnswer answer(command.json);
  const Configuration configuration =
      load_configuration(command.config, command.set, {}, command.pipeline);
  if (command.json)
    return answer.give({{"models", to_json(configuration.models)},
                        {"scenes", to_json(configuration.scenes)}}),
           0;
  std::cout << graph::to_dot({&configuration.models, &configuration.scenes});
  return 0;
}

namespace {

/// How to add to the house, before the reference of what is there.
constexpr const char* kHowToAdd = R"(## Add one

Each of these is one file, which registers itself, and its test. Nothing else names it: CMake, help,
this page, `posevote check` and the style tests find it.

| | put it into | example |
|---|---|---|
| a node | `nodes/VERB/NAME.cpp` | `tests/examples/crop_box.cpp` |
| a node that carries something from frame to frame | the same | `tests/examples/average_count.cpp` |
| a descriptor | `nodes/describe/describe_NAME.cpp` | `nodes/describe/describe_shot.cpp` |
| a format of scans and models | `nodes/formats/read_NAME.cpp` | `tests/examples/read_xyz.cpp` |
| a layout of data sets | `nodes/layouts/NAME.cpp` | `tests/examples/flat_folder.cpp` |
| a command | `tools/options/NAME.cpp` | `tests/examples/count_points.cpp` |

A node's file holds, in this order: a comment (what, from which paper, cost, how it fails, a line of YAML that
can be pasted), `struct Params` with defaults, the pure function `Out f(const In&..., const Params&)`, one
registration expression. The function may throw; the frame then fails by the node's name and the others go on. It
may use `graph/parallel.hpp` and nothing else of `graph/`. Its test runs it by name
(`tests/support/run_node.hpp`): `tests/nodes/VERB/NAME_test.cpp`. Then `posevote docs`.

A verb's folder holds its nodes and what is private to one of them. What two nodes share goes to a room: data,
color, geometry, descriptors, library, formats, layouts, density, poses, pictures, adapters. A room sees only those
before it, a verb no other verb; `tests/style/rooms_test.cpp` holds that. One sub-namespace a folder.

)";

}  // namespace

std::string node_reference() {
  std::map<std::string, std::string> folders;
  for (const NodeSpec* spec : graph::all_nodes()) folders[folder_of(*spec)] += section(*spec);
  std::string text =
      "# Nodes\n\nMade by `posevote docs` from the registry; do not edit. Lengths in metres; "
      "\"x resolution\" means\nmultiples of the run's voxel edge (`derive_scale`).\n\n";
  text += kHowToAdd;
  for (const std::string& folder : kWayOfTheData)
    if (folders.contains(folder))
      text += "## " + folder + "\n\n" + folders.extract(folder).mapped();
  for (const auto& [folder, sections] : folders) text += "## " + folder + "\n\n" + sections;
  text.pop_back();
  return text;
}

}  // namespace posevote
