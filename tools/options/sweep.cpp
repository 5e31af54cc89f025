// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/sweep.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

/// A sweep's own defaults.
struct Options : SweepCommand {
  Options() {
    run.out = "out/sweep";
    judge.rules = "adi15";
  }
};

void add_judging(CLI::App& app, SweepCommand& command) {
  app.add_option("--rules", command.judge.rules,
                 "When a pose is right: rules of `posevote evaluate` with commas between, or all; "
                 "each has a table, the first the plot")
      ->type_name("RULE")
      ->capture_default_str();
  app.add_option("--min-score", command.judge.min_score, "Count detections from this score up")
      ->check(number_in(-1e9, 1e9));
  app.add_option("--visible", command.judge.least_visible, "Leave out instances less visible")
      ->check(number_in(0, 1))
      ->capture_default_str();
  add_targets(app, command.targets);
}

void add_options(CLI::App& app, Options& options) {
  RunCommand& run = options.run;
  app.footer(
      "Example:\n  posevote sweep bop --dataset DIR --vary segment_objects.min_confidence=0.3,0.5,"
      "0.7\n      --vary describe_models.radius=12,15\n\n"
      "Tries every combination. What settings have in common runs once a scan; each is timed as "
      "if it\nwere alone, one scan at a time. Intervals: 95 %, bootstrap over scans; a setting is "
      "worse where\nthe interval of its difference from the best, on the same scans, holds no "
      "zero. Writes\nsweep.csv, sweep.json and sweep.svg to --out; scans.json and run.json there "
      "say "
      "what is done.\n\n"
      "Exit status: 0 done, 1 some scans failed or models were left out, 2 wrong usage, config or "
      "input,\n130 Ctrl-C, with the scans so far.");
  app.add_option("config", run.config,
                 "A file, or a name that `posevote configs` lists (demo, uwa, bop ...)")
      ->type_name("CONFIG")
      ->capture_default_str();
  app.add_option("--vary", options.vary,
                 "A parameter and the values that it is to have, with commas between (repeatable)")
      ->required()
      ->type_name("NODE.PARAM=VALUE,VALUE")
      ->allow_extra_args(false);
  app.add_option("--dataset", run.dataset,
                 "A data set with true poses (BOP, SIXD 2017, UWA, Queen's)")
      ->required()
      ->type_name("DIR");
  app.add_option("--split", run.split, "Split of the data set")->capture_default_str();
  app.add_option("--models", run.models, "Other model files than the data set's")
      ->type_name("FILE");
  app.add_option("--every", options.every, "Take one scan of so many")
      ->type_name("N")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_judging(app, options);
  app.add_option("--out", run.out, "Folder for the table and the plot")
      ->type_name("DIR")
      ->capture_default_str();
  CLI::Option* resume =
      app.add_flag("--resume", run.resume, "Go on in an --out that a sweep has begun");
  app.add_flag("--overwrite", run.overwrite, "Write anew what an earlier sweep wrote to --out")
      ->excludes(resume);
  app.add_option("--pipeline", run.pipeline,
                 "Other wiring than the config's, as `posevote configs` lists (ransac ...)")
      ->type_name("PIPELINE");
  add_set(app, run.set);
  add_threads(app, run.threads);
  add_seed(app, run.seed);
  add_cache(app, run.cache);
  add_json(app, run.json);
  app.add_flag("--quiet", run.quiet, "No progress");
}

const auto registered = register_command<Options>(
    "sweep", "Try values of parameters on a set with true poses", add_options,
    [](const Options& options) {
      return with_threads(options.run.threads,
                          [&] { return sweep_command(options, end_in_order()); });
    });

}  // namespace
}  // namespace posevote
