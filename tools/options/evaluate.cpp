// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"
#include "tools/commands.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, EvaluateCommand& command) {
  app.footer(
      "Example:\n  posevote evaluate lmo out/today/results.csv --rules all --out out/judged\n\n"
      "Rules: pose (50 mm, 7.5 deg), drost (diameter/10, 12 deg), add and adi15 (ADD/ADI 0.1 and\n"
      "0.15 diameter: of symmetric objects to the closest point), adds (ADD-S 0.1 diameter: of "
      "all\n"
      "objects to the closest point), BOP's average recalls mssd, mspd, vsd, and vsd18 (SIXD "
      "2018);\n"
      "or all. ECE: expected calibration error of the score as the probability to be right, of "
      "all\n"
      "detections in ten bins; where there is a results.json, by rules that tell look-alikes "
      "apart\n"
      "(all but adds and vsd18) of its pose_confidence. A column 'confidence' behind 'time' is\n"
      "judged instead of the score.\nin 95%: of right detections that have a covariance "
      "(results.json, also that beside "
      "a "
      "results.csv),\nthe share whose true error lies within its 95 % ellipsoid.");
  app.add_option("dataset", command.dataset, "A data set: BOP, SIXD 2017, UWA or Queen's")
      ->required()
      ->type_name("DIR");
  app.add_option("results", command.results, "The results.csv or results.json of a run on it")
      ->required()
      ->type_name("FILE");
  app.add_option("--split", command.split, "Split of the data set")->capture_default_str();
  app.add_option("--rules", command.rules,
                 "When a pose is right: rules with commas between, or all")
      ->default_str("pose,drost,add,adi15")
      ->type_name("RULE");
  app.add_option("--visible", command.visible, "Leave out instances less visible")
      ->check(number_in(0, 1))
      ->capture_default_str();
  add_targets(app, command.targets);
  app.add_option("--min-score", command.min_score,
                 "Count detections from this score up; curves and best F1 take all")
      ->check(number_in(-1e9, 1e9));
  app.add_option("--top", command.top, "Only so many detections of an object in an image")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--out", command.out, "Folder for tables (CSV, JSON) and plots (SVG)")
      ->type_name("DIR");
  add_json(app, command.json);
  app.add_flag("--verbose", command.verbose, "List all instances, however many");
}

const auto registered = register_command<EvaluateCommand>(
    "evaluate", "Compare results with a data set's true poses", add_options,
    [](const EvaluateCommand& command) {
      return with_threads(0, [&] { return evaluate_command(command); });
    });

}  // namespace
}  // namespace posevote
