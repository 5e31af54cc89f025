// SPDX-License-Identifier: BSD-3-Clause
// What is written from the program's own definitions: the reference of nodes, the man page, the
// shells' completion, and what these ask for.
#include <iostream>

#include "graph/mermaid.hpp"
#include "pipelines/configuration.hpp"
#include "tools/command_line.hpp"
#include "tools/commands.hpp"
#include "tools/docs/completion.hpp"
#include "tools/docs/man_page.hpp"
#include "tools/program.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

struct DocsCommand {
  std::string file = "nodes/README.md", completion, wiring;
  bool man = false, commands = false;
};

void add_options(CLI::App& app, DocsCommand& command) {
  app.footer(
      "Examples:\n  posevote docs --man > posevote.1\n"
      "  posevote docs --completion bash > ~/.local/share/bash-completion/completions/posevote");
  app.add_option("file", command.file, "The file to write the reference of nodes to")
      ->type_name("FILE")
      ->capture_default_str();
  app.add_flag("--man", command.man, "Print the man page instead");
  app.add_option("--completion", command.completion, "Print a shell's completion script instead")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  app.add_flag("--commands", command.commands, "Print the table of tools/README.md instead");
  app.add_option("--wiring", command.wiring,
                 "Print a config's wiring as a drawing for Markdown (Mermaid) instead, as in "
                 "graph/README.md; `posevote graph` is for Graphviz")
      ->type_name("CONFIG");
}

std::string drawing_of(const std::string& config) {
  const Configuration configuration = load_configuration(config, {}, {}, "");
  return graph::to_mermaid({&configuration.models, &configuration.scenes});
}

int docs_command(const DocsCommand& command) {
  if (!command.wiring.empty()) return std::cout << drawing_of(command.wiring), 0;
  const std::unique_ptr<Program> program = make_program();
  if (command.man) return std::cout << man_page(program->app), 0;
  if (command.commands) return std::cout << command_table(program->app), 0;
  if (!command.completion.empty()) return std::cout << completion_script(command.completion), 0;
  write_text(command.file, node_reference());
  std::cout << "wrote " << command.file << "\n";
  return 0;
}

const auto docs = register_command<DocsCommand>(
    "docs", "Write the reference of all nodes, the man page or completion", add_options,
    docs_command);

using Words = std::vector<std::string>;

/// For the scripts of --completion.
const auto complete_registered = register_command<Words>(
    "complete", "Print what fits in the place of the last word, for shells",
    [](CLI::App& app, Words& words) {
      app.group("");  // not shown
      app.add_option("words", words, "As typed behind posevote");
    },
    [](const Words& words) {
      const std::unique_ptr<Program> program = make_program();
      std::cout << to_text(complete(program->app, words.empty() ? Words{""} : words));
      return 0;
    });

}  // namespace
}  // namespace posevote
