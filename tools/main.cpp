// SPDX-License-Identifier: BSD-3-Clause
// The command line: its subcommands register themselves (tools/command_line.hpp), tools/program.hpp
// makes one tree of them.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "graph/plugin.hpp"
#include "graph/problem.hpp"
#include "tools/command_line.hpp"
#include "tools/heap.hpp"
#include "tools/program.hpp"
#include "tools/progress/console.hpp"

namespace {

using namespace posevote;

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
  const std::vector<std::string> left = app.remaining();
  if (left.empty()) {
    std::cerr << app.help();
    return 2;
  }
  const std::string near = meant(app, left.front());
  std::cerr << "no command is called '" << left.front() << "'"
            << (near.empty() ? "; `posevote --help` lists them" : near) << "\n";
  return 2;
}

/// Options that the command does not have; words too many, where there is none.
int refuse_extras(const CLI::App& app, std::vector<std::string> extras) {
  std::erase(extras, "--");
  const auto is_word = [](const std::string& text) { return !text.starts_with("-"); };
  if (!std::all_of(extras.begin(), extras.end(), is_word)) std::erase_if(extras, is_word);
  const std::string command = "posevote " + app.get_subcommands().front()->get_name();
  for (const std::string& text : extras)
    std::cerr << command << ": "
              << (is_word(text) ? "nothing is expected at '" + text + "'"
                                : "no option is called '" + text + "'" + meant(app, text))
              << "\n";
  std::cerr << "`" << command << " --help` lists what there is\n";
  return 2;
}

/// Whether something is left that the command does not know. It is told before what is missing.
bool has_extras(const CLI::App& app) {
  return !app.get_subcommands().empty() && app.remaining_size(true) > 0;
}

}  // namespace

int main(int argc, char** argv) {
  keep_heap();
  console::begin();
  remember_command(argc, argv);
  const std::unique_ptr<Program> program = make_program();
  CLI::App& app = program->app;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_answer = error.get_exit_code() == 0;  // --help and --version
    if (!is_answer && has_extras(app)) return refuse_extras(app, app.remaining(true));
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!program->chosen) return refuse_without_command(app);
  if (has_extras(app)) return refuse_extras(app, app.remaining(true));
  return run([&] {
    for (const std::string& plugin : program->plugins) graph::load_plugin(plugin);
    return program->chosen();
  });
}
