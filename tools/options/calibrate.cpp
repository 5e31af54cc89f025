// SPDX-License-Identifier: BSD-3-Clause
#include "tools/calibrate/calibrate.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, CalibrateCommand& command) {
  app.footer(
      "Examples:\n  posevote calibrate\n  posevote calibrate uwa icbin bop=DIR --out out/mine\n\n"
      "Runs on sets with true poses, keeps every pose that the search looks at, and fits the "
      "weights\nof the clues by logistic regression: of detections with confidence 0.8, eight in "
      "ten are right.\nPrints what images that the weights have not seen say of them, and the "
      "lines "
      "for a config.\n\n"
      "Exit status: 0 done, 1 some scans failed, 2 wrong usage, config or input, 130 Ctrl-C.");
  app.add_option("sets", command.sets, "Replicas by config; CONFIG=DIR for sets at hand")
      ->capture_default_str()
      ->type_name("SET");
  app.add_option("--out", command.out, "Folder for sets and runs")
      ->capture_default_str()
      ->type_name("DIR");
  app.add_option("--rule", command.rule, "When a pose is right, as evaluate says it")
      ->capture_default_str()
      ->type_name("RULE");
  app.add_option("--every", command.every, "Take one image of so many; 0: what suits the set")
      ->type_name("N")
      ->check(CLI::Range(0, 10000));
  app.add_flag("--colors", command.colors,
               "Paint the replicas, and fit what colours add to the clues as they are weighed now");
  add_set(app, command.set);
  add_json(app, command.json);
}

const auto registered = register_command<CalibrateCommand>(
    "calibrate", "Fit the confidence of detections to sets with true poses", add_options,
    [](const CalibrateCommand& command) {
      return with_threads(0, [&] { return calibrate_command(command, end_in_order()); });
    });

}  // namespace
}  // namespace posevote
