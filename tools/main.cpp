// SPDX-License-Identifier: BSD-3-Clause
// The command line: its subcommands register themselves (tools/command_line.hpp).
#include <malloc.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <stdexcept>

#include "graph/plugin.hpp"
#include "graph/problem.hpp"
#include "graph/schema.hpp"
#include "pipelines/recognizer.hpp"
#include "tools/command_line.hpp"
#include "tools/progress/console.hpp"

namespace {

using namespace posevote;

/// What one frame frees the next one takes. Otherwise the C library gives large blocks back to the
/// system, which clears them again page by page: a tenth of the time that the densities of half a
/// million votes take, a hundredth of a whole RGB-D frame's.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

/// Exit status 2 and a message for what the user can mend; 1 for what went wrong while it ran.
int run(const std::function<int()>& command) {
  try {
    return command();
  } catch (const graph::ConfigError& error) {
    std::cerr << error.what() << "\n";
  } catch (const std::invalid_argument& error) {
    spdlog::error("{}", error.what());
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return 1;
  }
  return 2;
}

/// A misspelt command is told with the one that was meant.
int refuse_without_command(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CommandEntry& entry : all_commands()) known.push_back(entry.name);
  const std::vector<std::string> left = app.remaining();
  if (left.empty()) {
    std::cerr << app.help();
    return 2;
  }
  const std::string near = graph::closest_name(left.front(), known);
  std::cerr << "no command is called '" << left.front() << "'"
            << (near.empty() ? "; `posevote --help` lists them" : ", did you mean '" + near + "'?")
            << "\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  console::begin();
  remember_command(argc, argv);
  CLI::App app("posevote finds known 3D objects in 3D scans.");
  app.set_version_flag("--version", "posevote " + version());
  std::vector<std::string> plugins;
  app.add_option("--plugin", plugins, "A shared library with nodes of one's own (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.require_subcommand(0, 1);
  app.allow_extras();
  std::function<int()> chosen;
  for (const CommandEntry& entry : all_commands()) {
    CLI::App* command = app.add_subcommand(entry.name, entry.help);
    command->fallthrough();  // so that --plugin may stand behind it
    command->callback([&chosen, run_it = entry.add(*command)] { chosen = run_it; });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!chosen) return refuse_without_command(app);
  return run([&] {
    for (const std::string& plugin : plugins) graph::load_plugin(plugin);
    return chosen();
  });
}
