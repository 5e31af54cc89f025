// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"
#include "tools/commands.hpp"

namespace posevote {
namespace {

struct Inspected {
  std::string config;
  std::vector<std::string> set;
  bool flat = false, json = false;
};

void add_config(CLI::App& app, Inspected& inspected) {
  app.add_option("config", inspected.config, "A file, or a name from configs/")
      ->required()
      ->type_name("CONFIG");
  add_set(app, inspected.set);
  add_json(app, inspected.json);
}

const auto check = register_command<Inspected>(
    "check", "Report every problem of a config at once",
    [](CLI::App& app, Inspected& inspected) {
      add_config(app, inspected);
      app.footer("Exit status: 0 the config is fine, 2 it is not.");
      app.add_flag("--flat", inspected.flat,
                   "Print the pipeline, with what it extends, as one file");
    },
    [](const Inspected& inspected) {
      return check_command(inspected.config, inspected.set, inspected.flat, inspected.json);
    });

const auto graph_registered = register_command<Inspected>(
    "graph", "Print the wiring as Graphviz DOT", add_config, [](const Inspected& inspected) {
      return graph_command(inspected.config, inspected.set, inspected.json);
    });

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
