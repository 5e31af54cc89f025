// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"
#include "tools/commands.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, InspectCommand& command) {
  app.add_option("config", command.config, "A file, or a name that `posevote configs` lists")
      ->required()
      ->type_name("CONFIG");
  app.add_option("--pipeline", command.pipeline, "Other wiring than the config's")
      ->type_name("PIPELINE");
  add_set(app, command.set);
  add_json(app, command.json);
}

const auto check = register_command<InspectCommand>(
    "check", "Report every problem of a config at once",
    [](CLI::App& app, InspectCommand& command) {
      add_options(app, command);
      app.footer("Exit status: 0 the config is fine, 2 it is not.");
      app.add_flag("--flat", command.flat, "Print the pipeline, with what it extends, as one file");
    },
    check_command);

const auto graph_registered = register_command<InspectCommand>(
    "graph", "Print the wiring as Graphviz DOT",
    [](CLI::App& app, InspectCommand& command) {
      add_options(app, command);
      app.footer("Example:\n  posevote graph uwa | dot -Tpng > uwa.png");
    },
    graph_command);

const auto configs = register_command<bool>(
    "configs", "List the configs and pipelines that can be named",
    [](CLI::App& app, bool& json) { add_json(app, json); }, configs_command);

struct Named {
  std::string name;
  bool json = false;
};

const auto nodes = register_command<Named>(
    "nodes", "List the node types, or explain one",
    [](CLI::App& app, Named& named) {
      app.add_option("name", named.name, "Node type")->type_name("NODE");
      add_json(app, named.json);
    },
    [](const Named& named) { return nodes_command(named.name, named.json); });

}  // namespace
}  // namespace posevote
