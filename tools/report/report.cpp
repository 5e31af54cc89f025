// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tools/report/folder.hpp"
#include "tools/report/sections.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

constexpr int kDepth = 2;  // an experiment holds methods, a method its evaluation

class Collector {
 public:
  Collector(fs::path top, std::size_t pictures) : top_(std::move(top)), pictures_(pictures) {}

  std::vector<html::Section> collect() {
    visit(top_, 0);
    return std::move(sections_);
  }

 private:
  void visit(const fs::path& folder, int depth) {
    const std::string where = depth == 0 ? "" : folder.lexically_relative(top_).string();
    append(experiment_sections(folder, where));
    append(run_sections(folder, where, pictures_));
    append(evaluation_sections(folder, where));
    if (depth == kDepth) return;
    std::error_code none;
    for (const fs::path& inner : list_folder(folder))
      if (fs::symlink_status(inner, none).type() == fs::file_type::directory)
        visit(inner, depth + 1);
  }

  void append(std::vector<html::Section> more) {
    std::move(more.begin(), more.end(), std::back_inserter(sections_));
  }

  fs::path top_;
  std::size_t pictures_;
  std::vector<html::Section> sections_;
};

}  // namespace

std::string report_page(const fs::path& folder, std::size_t pictures) {
  if (!fs::is_directory(folder)) throw std::invalid_argument(folder.string() + ": no such folder");
  const std::vector<html::Section> sections = Collector(folder, pictures).collect();
  if (sections.empty())
    throw std::invalid_argument(folder.string() +
                                ": nothing to report, expected results.json (of posevote run), "
                                "evaluation.json (of evaluate --out) or NAME.json, NAME.csv and "
                                "NAME.svg (of experiment), in it or the folders in it");
  // "." says nothing.
  return html::page(fs::canonical(folder).filename().string(), sections);
}

int report_command(const ReportCommand& command) {
  const fs::path file =
      command.out.empty() ? fs::path(command.folder) / "report.html" : fs::path(command.out);
  const std::string page = report_page(command.folder, command.pictures);
  write_text(file, page);
  std::printf("wrote %s (%.1f MB)\n", file.c_str(), 1e-6 * static_cast<double>(page.size()));
  return 0;
}

}  // namespace posevote
