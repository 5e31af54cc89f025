// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

/// What `report` and `view` have in common.
void add_page_options(CLI::App& app, ReportCommand& command) {
  app.add_option("--out", command.out, "The page; default report.html in the folder")
      ->type_name("FILE");
  app.add_option("--size", command.megabytes,
                 "About how large the page may be [MB]: the more scans, the fewer points of each")
      ->check(number_in(1, 1000))
      ->capture_default_str();
  app.add_option("--dataset", command.truth.dataset,
                 "A data set (BOP, SIXD 2017, UWA, Queen's) with true poses of the scans, to show "
                 "beside the found ones; default: that of the run")
      ->type_name("DIR");
  app.add_option("--split", command.truth.split, "Split of the data set")->capture_default_str();
  app.add_option("--scans", command.scans, "Only the scans of these names")->type_name("NAME");
  app.add_option(
         "--votes", command.votes,
         "Show the pose votes of this object, by name or obj_id, coloured by their density; "
         "each scan is run again up to them")
      ->type_name("OBJECT");
  app.add_flag("--explain", command.explain,
               "Say of each object why it was found or not (posevote explain); each scan is run "
               "again");
  app.add_flag("--open", command.open, "Show the page (xdg-open)");
}

void add_report(CLI::App& app, ReportCommand& command) {
  app.footer(
      "Example:\n  posevote report out/today\n\n"
      "Of the folder of a run, an evaluation or an experiment, and the folders in it: scans in "
      "3D,\n"
      "tables and plots, all in the page itself.");
  app.add_option("folder", command.folder, "What `run`, `evaluate` or `experiment` took as --out")
      ->required()
      ->type_name("DIR");
  add_page_options(app, command);
}

void add_view(CLI::App& app, ReportCommand& command) {
  app.footer(
      "Examples:\n  posevote view out/today\n"
      "  posevote view out/today --scans rs1 --votes chef --open\n\n"
      "Writes report.html into the run's folder: each scan in 3D with the found models over it,\n"
      "coloured by confidence, the best that was rejected, and true poses where there are any. It\n"
      "needs no network and no other file; the scans must still be where the run has read them.");
  app.add_option("folder", command.folder, "What `run` took as --out")
      ->required()
      ->type_name("DIR");
  add_page_options(app, command);
}

const auto registered = register_command<ReportCommand>(
    "report", "Make one HTML page of what others have written", add_report,
    [](const ReportCommand& command) {
      return with_threads(0, [&] { return report_command(command); });
    });

const auto view_registered =
    register_command<ReportCommand>("view", "Look at a run in 3D: make one HTML page of it",
                                    add_view, [](const ReportCommand& command) {
                                      return with_threads(0, [&] { return view_command(command); });
                                    });

}  // namespace
}  // namespace posevote
