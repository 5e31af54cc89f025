// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"
#include "tools/commands.hpp"

namespace posevote {
namespace {

struct Inspected {
  std::string config;
  std::vector<std::string> set;
  bool flat = false;
};

void add_config(CLI::App& app, Inspected& inspected) {
  app.add_option("config", inspected.config, "A file, or a name from configs/")->required();
  add_set(app, inspected.set);
}

const auto check = register_command<Inspected>(
    "check", "Report every problem of a config at once",
    [](CLI::App& app, Inspected& inspected) {
      add_config(app, inspected);
      app.add_flag("--flat", inspected.flat,
                   "Print the pipeline, with what it extends, as one file");
    },
    [](const Inspected& inspected) {
      return check_command(inspected.config, inspected.set, inspected.flat);
    });

const auto graph_registered = register_command<Inspected>(
    "graph", "Print the wiring as Graphviz DOT", add_config,
    [](const Inspected& inspected) { return graph_command(inspected.config, inspected.set); });

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
