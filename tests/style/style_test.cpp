// SPDX-License-Identifier: BSD-3-Clause
// What keeps the house in order: current docs, sound configs, tests for every node, TBB in its
// place.
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "graph/registry.hpp"
#include "pipelines/configuration.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/commands.hpp"

namespace posevote::style_test {

namespace fs = std::filesystem;

namespace {

const fs::path kSource = POSEVOTE_SOURCE_DIR;

std::vector<fs::path> files_in(const std::string& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / folder))
    if (endings.contains(entry.path().extension().string())) files.push_back(entry.path());
  return files;
}

/// The one optional dependency: two nodes and a pipeline are there only with it.
bool has_opencv() { return graph::find_node("opencv_ppf") != nullptr; }

}  // namespace

TEST_CASE("nodes/README.md is current: run `posevote docs` when this fails", "[style]") {
  if (!has_opencv()) {
    WARN("skipped: built without OpenCV");
    return;
  }
  CHECK(test::read_text(kSource / "nodes/README.md") == node_reference());
}

TEST_CASE("every config and pipeline of the project passes check", "[style]") {
  for (const fs::path& config : files_in("configs", {".yaml"})) {
    if (test::read_text(config).find("pipeline:") == std::string::npos) continue;  // a scene spec
    INFO(config.string());
    CHECK_NOTHROW(load_configuration(config.string(), {}));
  }
  for (const fs::path& pipeline : files_in("pipelines", {".yaml"})) {
    if (pipeline.stem() == "opencv_ppf" && !has_opencv()) continue;
    INFO(pipeline.string());
    CHECK_NOTHROW(load_configuration(pipeline.string(), {}));
  }
}

TEST_CASE("every node has a file comment with an example, and a test", "[style]") {
  for (const graph::NodeSpec* spec : graph::all_nodes()) {
    INFO(spec->name);
    // The compiler may have been told of the file by a path relative to its own folder.
    const fs::path source = kSource / spec->source.substr(spec->source.rfind("nodes/"));
    CHECK(test::read_text(source).find(spec->name + ": {") != std::string::npos);
    bool tested = false;
    for (const fs::path& file : files_in("tests", {".cpp", ".hpp"}))
      tested = tested || test::read_text(file).find("\"" + spec->name + "\"") != std::string::npos;
    CHECK(tested);
  }
}

TEST_CASE("only graph/ and the command line see TBB, and nodes no YAML but layouts'", "[style]") {
  for (const fs::path& file : files_in("nodes", {".cpp", ".hpp"})) {
    INFO(file.string());
    const std::string text = test::read_text(file);
    CHECK(text.find("tbb/") == std::string::npos);
    if (file.parent_path().filename() != "layouts")  // data sets may be described in YAML
      CHECK(text.find("yaml-cpp") == std::string::npos);
    CHECK(text.find("spdlog") == std::string::npos);
  }
  for (const fs::path& file : files_in("tools", {".cpp", ".hpp"}))
    CHECK(test::read_text(file).find("tbb/flow_graph") == std::string::npos);
}

TEST_CASE("PCL stays out of headers", "[style]") {
  for (const std::string folder : {"graph", "nodes", "tools"})
    for (const fs::path& file : files_in(folder, {".hpp"})) {
      INFO(file.string());
      CHECK(test::read_text(file).find("#include <pcl") == std::string::npos);
    }
}

}  // namespace posevote::style_test
