// SPDX-License-Identifier: BSD-3-Clause
// `posevote configs`: what can be named on the command line, what it is for and where it lies.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include "pipelines/installed.hpp"
#include "tools/commands.hpp"
#include "tools/json_answer.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

enum class Kind { kConfig, kPipeline, kScenes };

struct Named {
  Kind kind;
  fs::path file;
  std::string purpose;
};

const char* name_of(Kind kind) {
  return kind == Kind::kConfig ? "config" : kind == Kind::kPipeline ? "pipeline" : "scenes";
}

/// The first sentence of the comment that a file begins with.
std::string purpose_of(const fs::path& file) {
  std::string text;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line) && line.starts_with("# ");)
    text += (text.empty() ? "" : " ") + line.substr(2);
  return text.substr(0, text.find(". "));
}

std::vector<Named> files_in(const fs::path& folder, bool pipelines) {
  std::vector<Named> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    const bool scenes = entry.path().stem().string().ends_with("_scenes");
    found.push_back({pipelines ? Kind::kPipeline
                     : scenes  ? Kind::kScenes
                               : Kind::kConfig,
                     entry.path(), purpose_of(entry.path())});
  }
  std::sort(found.begin(), found.end(),
            [](const Named& a, const Named& b) { return a.file < b.file; });
  return found;
}

void print(const std::vector<Named>& all, Kind kind, const std::string& heading) {
  std::cout << heading << "\n";
  for (const Named& named : all)
    if (named.kind == kind)
      std::cout << format("  %-20s ", named.file.stem().c_str()) << named.purpose << "\n";
}

nlohmann::ordered_json to_json(const std::vector<Named>& all) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Named& named : all)
    list.push_back({{"kind", name_of(named.kind)},
                    {"name", named.file.stem().string()},
                    {"purpose", named.purpose},
                    {"file", named.file.string()}});
  return list;
}

}  // namespace

int configs_command(bool json) {
  const fs::path folder = shared_folder();
  std::vector<Named> all = files_in(folder / "configs", false);
  for (Named& named : files_in(folder / "pipelines", true)) all.push_back(std::move(named));
  const JsonAnswer answer(json);
  if (answer.wanted()) return answer.give(to_json(all)), 0;
  print(all, Kind::kConfig, "Configs, for `posevote run NAME`:");
  print(all, Kind::kPipeline, "\nPipelines, for `posevote run NAME --pipeline NAME`:");
  print(all, Kind::kScenes, "\nScenes that can be made, for `posevote simulate FILE`:");
  std::cout << "\nThey lie in " << folder.string()
            << "/configs and /pipelines; copy one to make your own, and give its path.\n";
  return 0;
}

}  // namespace posevote
