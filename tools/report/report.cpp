// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tools/report/folder.hpp"
#include "tools/report/pack.hpp"
#include "tools/report/sections.hpp"
#include "tools/report/template.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

constexpr int kDepth = 2;  // an experiment holds methods, a method its evaluation

/// A folder of ours, and what the page calls it.
struct Place {
  fs::path folder;
  std::string where;
};

/// The folder and those in it; not through links.
void collect(const fs::path& folder, const fs::path& top, int depth, std::vector<Place>& places) {
  places.push_back({folder, depth == 0 ? "" : folder.lexically_relative(top).string()});
  if (depth == kDepth) return;
  std::error_code none;
  for (const fs::path& inner : list_folder(folder))
    if (fs::symlink_status(inner, none).type() == fs::file_type::directory)
      collect(inner, top, depth + 1, places);
}

/// Shares the page among all scans: a fifth goes to the models and to what is said of the scans.
page::RunView make_view(const ReportCommand& command, const std::vector<Place>& places) {
  constexpr std::size_t kFewest = 1000, kMost = 80000;  // points of a scan
  page::RunView view{0, 4000, command.votes, command.scans, command.explain};
  std::size_t scans = 0, runs = 0;
  for (const Place& place : places)
    if (holds_run(place.folder)) {
      scans += page::count_scans(read_run(place.folder), view);
      ++runs;
    }
  const double bytes =
      std::max(0.0, command.megabytes * 1e6 - static_cast<double>(html::kViewerScript.size()));
  const double points =
      0.8 * bytes / page::kBytesPerPoint / static_cast<double>(std::max<std::size_t>(scans, 1));
  view.points = points < kFewest ? 0 : std::min(kMost, static_cast<std::size_t>(points));
  view.faces /= std::max<std::size_t>(1, runs);
  return view;
}

void check_scans(const ReportCommand& command, const std::vector<Place>& places) {
  for (const std::string& name : command.scans) {
    std::size_t count = 0;
    for (const Place& place : places)
      if (holds_run(place.folder))
        count += page::count_scans(read_run(place.folder), {0, 0, "", {name}, false});
    if (count == 0)
      throw std::invalid_argument("--scans " + name + ": " + command.folder +
                                  " has no scan of that name");
  }
}

/// Shows the page to the user, if there is a screen to show it on.
void open_page(const fs::path& file) {
  const std::string path = fs::absolute(file).string();
  const pid_t child = fork();
  if (child == 0) {
    execlp("xdg-open", "xdg-open", path.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0)
    throw std::runtime_error("--open: xdg-open cannot show " + path);
}

}  // namespace

std::string report_page(const ReportCommand& command) {
  const fs::path top = command.folder;
  if (!fs::is_directory(top)) throw std::invalid_argument(top.string() + ": no such folder");
  std::vector<Place> places;
  collect(top, top, 0, places);
  check_scans(command, places);
  const page::RunView view = make_view(command, places);
  std::vector<html::Section> sections;
  const auto append = [&sections](std::vector<html::Section> more) {
    std::move(more.begin(), more.end(), std::back_inserter(sections));
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [folder, where] = places[i];
    append(experiment_sections(folder, where));
    if (holds_run(folder))
      append({run_section(folder, where, command.truth, view, "run" + std::to_string(i))});
    append(evaluation_sections(folder, where));
  }
  if (sections.empty())
    throw std::invalid_argument(top.string() +
                                ": nothing to report, expected results.json (of posevote run), "
                                "evaluation.json (of evaluate --out) or NAME.json, NAME.csv and "
                                "NAME.svg (of experiment), in it or the folders in it");
  // "." says nothing.
  return html::page(fs::canonical(top).filename().string(), sections);
}

int report_command(const ReportCommand& command) {
  const fs::path file =
      command.out.empty() ? fs::path(command.folder) / "report.html" : fs::path(command.out);
  const std::string page = report_page(command);
  write_text(file, page);
  std::printf("wrote %s (%.1f MB)\n", file.c_str(), 1e-6 * static_cast<double>(page.size()));
  std::fflush(stdout);
  if (command.open) open_page(file);
  return 0;
}

int view_command(const ReportCommand& command) {
  if (fs::is_directory(command.folder) && !holds_run(command.folder))
    throw std::invalid_argument(command.folder +
                                ": no results.json of a run in it; `posevote report` shows "
                                "evaluations and experiments");
  return report_command(command);
}

}  // namespace posevote
