// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/experiment.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, ExperimentCommand& command) {
  app.footer(
      "Examples:\n  posevote experiment sensitivity --dataset bunny.ply\n"
      "  posevote experiment parts --every 10\n"
      "  posevote experiment ranges --scales 0.001 0.002 0.004\n"
      "  posevote experiment calibration --runs lmo=out/lmo/results.csv "
      "ycbv=out/ycbv/results.csv\n\n"
      "uwa, queens, icbin, icmi: our method and its rivals on one data set, the paper's table with "
      "ours\nbeside it. parts, household: the same on CAD parts at three noise levels, and on "
      "objects of\nYCB's sizes. ranges: recall over distance and noise. calibration: how far the "
      "scores of\nresults can be believed as probabilities. CSV and plots go to --out. A run that "
      "was stopped\ngoes on where it was.\n\n"
      "Exit status: 0 done, 1 some scans failed, 2 wrong usage, config or input, 130 Ctrl-C.");
  const std::vector<std::string> names{"sensitivity", "uwa",     "queens",    "icbin",
                                       "icmi",        "parts",   "household", "ranges",
                                       "calibration", "ablation"};
  app.add_option("name", command.name, "Which one")->required()->check(CLI::IsMember(names));
  app.add_option("--dataset", command.dataset,
                 "The real data (sensitivity: a mesh in m); default: a replica is made")
      ->type_name("PATH");
  app.add_option("--out", command.out, "Folder for everything; default out/NAME")->type_name("DIR");
  app.add_option("--methods", command.methods, "Only these, e.g. posevote ransac")
      ->type_name("METHOD");
  app.add_option("--every", command.every, "Take one image of so many; of sets of images only")
      ->type_name("N")
      ->check(CLI::Range(1, 10000));
  app.add_option("--scales", command.scales, "Ranges: fixed resolutions to compare with")
      ->type_name("METRES")
      ->check(number_in(0.0001, 0.1));
  app.add_option("--runs", command.runs, "Calibration: data sets and results of runs on them")
      ->type_name("DATASET=RESULTS");
  app.add_option("--rule", command.rule, "Calibration: when a pose is right; default add")
      ->type_name("RULE");
  app.add_option("--sets", command.sets, "Ablation: replicas, CONFIG=DIR for real sets")
      ->type_name("SET");
  app.add_option("--terms", command.terms, "Ablation: only these parameters")->type_name("PARAM");
  add_json(app, command.json);
  app.add_flag("--quick", command.quick, "A small part of it, to see that it works");
}

const auto registered = register_command<ExperimentCommand>(
    "experiment", "Repeat one of the paper's experiments, or of ours", add_options,
    [](const ExperimentCommand& command) {
      return with_threads(0, [&] { return experiment_command(command, end_in_order()); });
    });

}  // namespace
}  // namespace posevote
