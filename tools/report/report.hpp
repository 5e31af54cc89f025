// SPDX-License-Identifier: BSD-3-Clause
// `posevote report`: what a run, an evaluation or an experiment has left, as one HTML page.
#pragma once

#include <filesystem>
#include <string>

namespace posevote {

/// Options of `report`, named as on the command line.
struct ReportCommand {
  std::string folder;
  std::string out;            ///< empty: report.html in the folder
  std::size_t pictures = 50;  ///< on the page, at most
};
int report_command(const ReportCommand& command);

/// The page, which needs no other file. Of `folder` and the folders in it, two deep. Throws
/// std::invalid_argument naming a folder that holds nothing of ours.
std::string report_page(const std::filesystem::path& folder, std::size_t pictures);

}  // namespace posevote
