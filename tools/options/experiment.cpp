// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/experiment.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, ExperimentCommand& command) {
  app.footer(
      "Example:\n  posevote experiment sensitivity --dataset bunny.ply\n\n"
      "Runs our method and its rivals on one data set and prints the paper's table with ours "
      "beside\nit; CSV and plots go to --out. A run that was stopped goes on where it was.");
  app.add_option("name", command.name, "sensitivity, uwa, queens, icbin, icmi or ablation")
      ->required()
      ->check(CLI::IsMember({"sensitivity", "uwa", "queens", "icbin", "icmi", "ablation"}));
  app.add_option("--dataset", command.dataset,
                 "The real data (sensitivity: a mesh in m); default: a replica is made")
      ->type_name("PATH");
  app.add_option("--out", command.out, "Folder for everything; default out/NAME")->type_name("DIR");
  app.add_option("--methods", command.methods, "Only these, e.g. posevote ransac")
      ->type_name("NAME");
  app.add_option("--every", command.every, "Take one image of so many; of sets of images only")
      ->type_name("N")
      ->check(CLI::Range(1, 10000));
  app.add_option("--sets", command.sets, "Ablation: replicas, CONFIG=DIR for real sets")
      ->type_name("SET");
  app.add_option("--terms", command.terms, "Ablation: only these parameters")->type_name("PARAM");
  app.add_flag("--quick", command.quick, "A small part of it, to see that it works");
}

const auto registered = register_command<ExperimentCommand>(
    "experiment", "Repeat one of the paper's experiments", add_options,
    [](const ExperimentCommand& command) {
      return with_threads(0, [&] { return experiment_command(command, end_in_order()); });
    });

}  // namespace
}  // namespace posevote
