// SPDX-License-Identifier: BSD-3-Clause
// Where things stand under nodes/. Rooms hold what several nodes share, and see only the rooms
// before them in kRooms. Verbs hold nodes and what is private to one node, and see no other verb.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "graph/registry.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::rooms_test {

namespace fs = std::filesystem;

namespace {

const fs::path kSource = POSEVOTE_SOURCE_DIR;

/// From the ground up.
const std::vector<std::string> kRooms{"data",    "color",   "geometry", "descriptors",
                                      "pairs",   "library", "formats",  "layouts",
                                      "density", "poses",   "pictures", "adapters"};
const std::vector<std::string> kVerbs{"load",  "prepare", "describe", "match",   "vote",
                                      "train", "segment", "write",    "baseline"};

struct File {
  std::string room;  ///< folder under nodes/
  std::set<std::string> includes;
  std::size_t lines = 0;
  bool is_node = false;
};

/// By path from the root, as in #include.
std::map<std::string, File> read_files() {
  static const std::regex include("#include \"([^\"]+)\"");
  std::map<std::string, File> files;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "nodes")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    const std::string text = test::read_text(entry.path());
    File& file = files[entry.path().lexically_relative(kSource).string()];
    file.room = entry.path().parent_path().filename().string();
    file.lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at)
      file.includes.insert((*at)[1]);
  }
  for (const graph::NodeSpec* spec : graph::all_nodes())
    files[spec->source.substr(spec->source.rfind("nodes/"))].is_node = true;
  return files;
}

const std::map<std::string, File>& files() {
  static const std::map<std::string, File> all = read_files();
  return all;
}

bool is_verb(const std::string& room) {
  return std::find(kVerbs.begin(), kVerbs.end(), room) != kVerbs.end();
}

/// How far up a room stands; all verbs stand on top.
std::size_t height(const std::string& room) {
  return static_cast<std::size_t>(std::find(kRooms.begin(), kRooms.end(), room) - kRooms.begin());
}

/// The nodes that see a header, directly or through others of their folder.
std::set<std::string> nodes_with(const std::string& header) {
  std::set<std::string> seen{header};
  for (std::size_t before = 0; before != seen.size();) {
    before = seen.size();
    for (const auto& [path, file] : files())
      for (const std::string& included : file.includes)
        if (seen.contains(included)) {
          seen.insert(path);
          const fs::path declared = fs::path(path).replace_extension(".hpp");
          if (files().contains(declared.string())) seen.insert(declared.string());
        }
  }
  std::set<std::string> nodes;
  for (const std::string& path : seen)
    if (files().at(path).is_node) nodes.insert(path);
  return nodes;
}

}  // namespace

TEST_CASE("every folder under nodes/ is a room or a verb", "[style]") {
  for (const auto& [path, file] : files()) {
    INFO(path);
    CHECK((is_verb(file.room) || height(file.room) < kRooms.size()));
    CHECK(file.is_node <= is_verb(file.room));
  }
}

TEST_CASE("rooms see only what stands below them, and no verb sees another", "[style]") {
  for (const auto& [path, file] : files())
    for (const std::string& included : file.includes) {
      INFO(path << " includes " << included);
      const auto other = files().find(included);
      if (other == files().end()) {
        CHECK(included.starts_with("graph/"));
        continue;
      }
      const std::string& room = other->second.room;
      if (room == file.room) continue;
      CHECK_FALSE(is_verb(room));
      CHECK(height(room) < height(file.room));
    }
}

TEST_CASE("a verb holds nodes and what is private to one of them", "[style]") {
  std::size_t all = 0, helpers = 0;
  for (const auto& [path, file] : files()) {
    if (!is_verb(file.room)) continue;
    INFO(path);
    all += file.lines;
    if (!file.is_node) helpers += file.lines;
    if (!file.is_node && path.ends_with(".hpp")) CHECK(nodes_with(path).size() == 1);
  }
  CHECK(helpers < all / 2);
}

TEST_CASE("one sub-namespace a room", "[style]") {
  for (const auto& [path, file] : files()) {
    INFO(path);
    const std::string text = test::read_text(kSource / path);
    const std::string own = file.room == "data" ? "namespace posevote {" : "posevote::" + file.room;
    CHECK(text.find(own) != std::string::npos);
  }
}

TEST_CASE("no file is longer than 300 lines", "[style]") {
  for (const std::string folder : {"graph", "nodes", "tools", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      INFO(entry.path().string());
      const std::string text = test::read_text(entry.path());
      CHECK(std::count(text.begin(), text.end(), '\n') <= 300);
    }
}

}  // namespace posevote::rooms_test
