// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"
#include "tools/commands.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, TrainCommand& command) {
  app.footer(
      "Example:\n  posevote train --models parts/*.stl --out parts.library\n\n"
      "Exit status: 0 done, 1 models were left out or it failed on the way, 2 wrong usage, config "
      "or input.");
  app.add_option("config", command.config, "The config that the runs will use")
      ->type_name("CONFIG")
      ->capture_default_str();
  app.add_option("--models", command.models, "Model files, folders or globs")
      ->required()
      ->type_name("FILE");
  app.add_option("--out", command.out, "The library's file")->required()->type_name("FILE");
  app.add_option("--on-error", command.on_error, "After a model that cannot be used")
      ->check(CLI::IsMember({"skip", "stop"}))
      ->capture_default_str();
  app.add_flag("--quiet", command.quiet, "No line that shows how far it is");
  app.add_flag("--report", command.report, "List the symmetries of each model, exact and near");
  add_json(app, command.json);
  add_unit(app, "--model-unit", command.model_unit, "Unit of length in model files");
  add_set(app, command.set);
}

const auto registered =
    register_command<TrainCommand>("train", "Prepare models once, for `run --library`", add_options,
                                   [](const TrainCommand& command) {
                                     return with_threads(0, [&] { return train_command(command); });
                                   });

}  // namespace
}  // namespace posevote
