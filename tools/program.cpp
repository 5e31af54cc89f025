// SPDX-License-Identifier: BSD-3-Clause
#include "tools/program.hpp"

#include <algorithm>

#include "graph/did_you_mean.hpp"
#include "pipelines/recognizer.hpp"
#include "tools/command_line.hpp"

namespace posevote {
namespace {

constexpr const char* kExitStatus =
    "Exit status: 0 done, 1 it failed on the way, 2 wrong usage, config or input: nothing ran.";

void add(Program& program, const CommandEntry& entry) {
  CLI::App* command = program.app.add_subcommand(entry.name, entry.help);
  command->fallthrough();  // so that --plugin may stand behind it
  command->callback([&program, run_it = entry.add(*command)] { program.chosen = run_it; });
  const std::string footer = command->get_footer();
  if (footer.find("Exit status") == std::string::npos)
    command->footer(footer + (footer.empty() ? "" : "\n\n") + kExitStatus);
}

/// The command that was parsed, else the program itself.
const CLI::App& parsed(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

}  // namespace

std::unique_ptr<Program> make_program() {
  auto program = std::make_unique<Program>();
  CLI::App& app = program->app;
  app.description("posevote finds known 3D objects in 3D scans.");
  app.name("posevote");
  app.set_version_flag("--version", "posevote " + version());
  app.add_option("--plugin", program->plugins,
                 "A shared library with nodes of one's own (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.footer(std::string("`posevote COMMAND --help` explains a command.\n\n") + kExitStatus);
  app.require_subcommand(0, 1);
  app.allow_extras();
  for (const CommandEntry& entry : all_commands()) add(*program, entry);
  return program;
}

std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> shown_options(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) {
    return option->nonpositional() && !option->get_group().empty();
  });
}

std::vector<const CLI::Option*> shown_arguments(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) {
    return option->get_positional() && !option->get_group().empty();
  });
}

std::string value_name(const CLI::Option& option) {
  std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos)
    return type.substr(0, type.find(':'));
  type = type.substr(open + 1, close - open - 1);  // "TEXT:{skip,stop}" of CLI::IsMember
  std::replace(type.begin(), type.end(), ',', '|');
  return type;
}

std::string meant(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  if (word.starts_with("-")) {
    for (const CLI::App* from : {&parsed(app), &app})
      for (const CLI::Option* option : shown_options(*from))
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  } else {
    for (const CLI::App* command : shown_commands(app)) known.push_back(command->get_name());
  }
  return graph::did_you_mean(word.substr(0, word.find('=')), known);
}

}  // namespace posevote
