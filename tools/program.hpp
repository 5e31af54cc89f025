// SPDX-License-Identifier: BSD-3-Clause
// The whole command line as one tree of definitions, from which parsing, help, the man page and
// completion are made.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace posevote {

struct Program {
  CLI::App app;
  std::vector<std::string> plugins;
  std::function<int()> chosen;  ///< runs the command that was parsed; null: none was named
};

/// With every command that is registered. Parse it once.
std::unique_ptr<Program> make_program();

/// The commands that help shows, in alphabetical order.
std::vector<const CLI::App*> shown_commands(const CLI::App& app);

/// The options that help shows, or the arguments without a name, in the order of their definition.
std::vector<const CLI::Option*> shown_options(const CLI::App& command);
std::vector<const CLI::Option*> shown_arguments(const CLI::App& command);

/// What help calls an option's value, as "FILE"; for a closed set its values, as "skip|stop".
std::string value_name(const CLI::Option& option);

/// What a misspelt command or option was meant to be: ", did you mean '--models'?" or "". `word` as
/// typed; options as "--name" or "--name=value".
std::string meant(const CLI::App& app, const std::string& word);

}  // namespace posevote
