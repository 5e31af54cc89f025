// SPDX-License-Identifier: BSD-3-Clause
// `posevote report` and `view`: what a run, an evaluation or an experiment has left, as one HTML
// page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/report/shown_run.hpp"

namespace posevote {

/// Options of `report` and `view`, named as on the command line.
struct ReportCommand {
  std::string folder;
  std::string out;        ///< empty: report.html in the folder
  double megabytes = 30;  ///< --size: of the page, about
  page::TruthSource truth;
  std::string votes;               ///< name or obj_id of an object; empty: none
  std::vector<std::string> scans;  ///< only these, by name; empty: all
  bool explain = false;            ///< why each object was found or not
  bool open = false;
};
int report_command(const ReportCommand& command);
/// The same of one run alone.
int view_command(const ReportCommand& command);

/// The page, which needs no other file. Of command.folder and the folders in it, two deep. Throws
/// std::invalid_argument naming a folder that holds nothing of ours, and what was asked for and
/// cannot be shown.
std::string report_page(const ReportCommand& command);

}  // namespace posevote
