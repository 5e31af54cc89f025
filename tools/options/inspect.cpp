// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"
#include "tools/commands.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, InspectCommand& command) {
  app.add_option("config", command.config, "A file, or a name that `posevote configs` lists")
      ->required();
  app.add_option("--pipeline", command.pipeline, "Other wiring than the config's")
      ->type_name("NAME");
  add_set(app, command.set);
}

const auto check = register_command<InspectCommand>(
    "check", "Report every problem of a config at once",
    [](CLI::App& app, InspectCommand& command) {
      add_options(app, command);
      app.add_flag("--flat", command.flat, "Print the pipeline, with what it extends, as one file");
    },
    check_command);

const auto graph_registered = register_command<InspectCommand>(
    "graph", "Print the wiring as Graphviz DOT: posevote graph uwa | dot -Tpng > uwa.png",
    add_options, graph_command);

const auto configs = register_command<bool>(
    "configs", "List the configs and pipelines that can be named",
    [](CLI::App& app, bool& json) { app.add_flag("--json", json, "As JSON"); }, configs_command);

const auto nodes = register_command<std::string>(
    "nodes", "List the node types, or explain one",
    [](CLI::App& app, std::string& name) { app.add_option("name", name, "Node type"); },
    nodes_command);

const auto docs = register_command<std::string>(
    "docs", "Write the reference of all nodes",
    [](CLI::App& app, std::string& file) {
      app.add_option("file", file, "The file to write")->default_val("nodes/README.md");
    },
    docs_command);

}  // namespace
}  // namespace posevote
