// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.hpp"

#include <limits>

#include "tools/command_line.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, ReportCommand& command) {
  app.footer(
      "Example:\n  posevote report out/today\n\n"
      "Of the folder of a run, an evaluation or an experiment, and the folders in it: tables, "
      "plots\n"
      "and pictures, all in the page itself.");
  app.add_option("folder", command.folder, "What `run`, `evaluate` or `experiment` took as --out")
      ->required()
      ->type_name("DIR");
  app.add_option("--out", command.out, "The page; default report.html in the folder")
      ->type_name("FILE");
  app.add_option("--pictures", command.pictures, "Take in so many pictures at most")
      ->check(whole_number(std::numeric_limits<std::size_t>::max()))
      ->capture_default_str();
}

const auto registered = register_command<ReportCommand>(
    "report", "Make one HTML page of what others have written", add_options,
    [](const ReportCommand& command) { return report_command(command); });

}  // namespace
}  // namespace posevote
