// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"
#include "tools/commands.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, SimulateCommand& command) {
  app.footer(
      "Example:\n  posevote simulate configs/demo_scenes.yaml --out out/scenes\n\n"
      "Writes a data set in BOP layout, with true poses, and PLY scans in metres beside it.");
  app.add_option("spec", command.spec, "What to make (YAML)")->required();
  app.add_option("--out", command.out, "A new or empty folder for the data set")
      ->required()
      ->type_name("DIR");
}

const auto registered = register_command<SimulateCommand>(
    "simulate", "Make models and cluttered scans of them", add_options,
    [](const SimulateCommand& command) {
      return with_threads(0, [&] { return simulate_command(command); });
    });

}  // namespace
}  // namespace posevote
