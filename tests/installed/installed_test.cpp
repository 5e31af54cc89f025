// SPDX-License-Identifier: BSD-3-Clause
// What other programs use, as it is after `cmake --install`: the program away from its sources, the
// library, plugins and the Python module, each by a worked example.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/installed/shell.hpp"

namespace posevote::installed_test {

using namespace posevote::test;
namespace fs = std::filesystem;

namespace {

const fs::path kExamples = fs::path(POSEVOTE_SOURCE_DIR) / "tests/installed";

/// An installation in a folder of its own, made once for all cases.
struct Installed {
  TemporaryFolder folder;
  fs::path prefix = folder / "prefix";

  Installed() {
    const CommandResult done =
        run("cmake --install '" POSEVOTE_BUILD_DIR "' --prefix '" + prefix.string() + "'");
    INFO(done.output);
    REQUIRE(done.status == 0);
  }

  CommandResult run(const std::string& command) const { return run_in(folder, command); }
  CommandResult posevote(const std::string& arguments) const {
    return run("'" + (prefix / "bin/posevote").string() + "' " + arguments);
  }

  /// A copy of an example, built against the installation; `flags`: more for CMake.
  fs::path build(const std::string& example, const std::string& as,
                 const std::string& flags = "") const {
    const fs::path copy = folder / as;
    fs::copy(kExamples / example, copy, fs::copy_options::recursive);
    const CommandResult done =
        run("cmake -S '" + copy.string() + "' -B '" + (copy / "build").string() +
            "' -DCMAKE_PREFIX_PATH='" + prefix.string() + "' " + flags + " && cmake --build '" +
            (copy / "build").string() + "'");
    INFO(done.output);
    REQUIRE(done.status == 0);
    return copy / "build";
  }
};

const Installed& installed() {
  static const Installed once;
  return once;
}

}  // namespace

TEST_CASE("the installed program runs away from its sources", "[installed]") {
  const Installed& here = installed();
  CHECK(contains(here.posevote("--version"), "posevote 0."));
  CHECK(contains(here.posevote("check uwa"), "uwa: fine"));
  CHECK(contains(here.posevote("check hough3d_of_my_own"), "hough3d_of_my_own"));
  CHECK(contains(here.posevote("nodes describe_shot"), "SHOT"));  // of a library beside the program
  here.folder.write("spec.yaml",
                    "seed: 5\nmodels:\n  - {shape: figure, seed: 3, size: 0.2}\n"
                    "scenes:\n  - {sensor: rgbd, objects: [1], clutter: 1}\n");
  CHECK(here.posevote("simulate spec.yaml --out data").status == 0);
  const CommandResult found =
      here.posevote("run --models data/models --scenes data/scans --out out");
  CHECK(contains(found, "1 frames answered, 0 failed"));
  CHECK(read_json(here.folder / "out/results.json")["frames"][0]["detections"].size() == 1);
}

TEST_CASE("a misspelt command is told with the one that was meant", "[installed]") {
  const CommandResult wrong = installed().posevote("rum x");
  CHECK(wrong.status == 2);
  CHECK(contains(wrong, "did you mean 'run'?"));
}

TEST_CASE("the program starts with few libraries", "[installed]") {
  const CommandResult linked = installed().run(
      "ldd '" + (installed().prefix / "bin/posevote").string() + "' | grep -c '=>'");
  INFO(linked.output);
  CHECK(std::stoi(linked.output) <= 25);
}

TEST_CASE("a C++ program finds a part by find_package(posevote)", "[installed]") {
  const Installed& here = installed();
  const fs::path build = here.build("cpp", "cpp");
  const CommandResult found = here.run("'" + (build / "find_part").string() + "'");
  CHECK(found.status == 0);
  const std::size_t line = found.output.find("box: ");
  REQUIRE(line != std::string::npos);
  double confidence = 0, x = 9, y = 9, z = 9;
  CHECK(std::sscanf(found.output.c_str() + line, "box: confidence %lf at %lf %lf %lf mm",
                    &confidence, &x, &y, &z) == 4);
  CHECK(confidence > 0.5);
  CHECK(std::abs(x) + std::abs(y) + std::abs(z) < 1);
  const CommandResult none = here.run("'" + (build / "find_part").string() + "' no.stl no.ply");
  CHECK(none.status == 1);
  CHECK(contains(none, "no.stl"));
}

TEST_CASE("nodes come from outside", "[installed]") {
  const Installed& here = installed();
  const fs::path plugin = here.build("plugin", "plugin") / "libkeep_near.so";
  CHECK(contains(here.posevote("nodes keep_near --plugin '" + plugin.string() + "'"),
                 "distance: number = 2 [m], > 0"));
  here.folder.write("near.yaml",
                    "extends: recognize\nplugins: [plugin/build/libkeep_near.so]\n"
                    "insert:\n  keep_near: {into: raw_scan, distance: 3}\n");
  CHECK(contains(here.posevote("check near.yaml"), "near.yaml: fine"));
  const CommandResult wrong = here.posevote("check near.yaml --set keep_near.distance=-1");
  CHECK(wrong.status == 2);
  CHECK(contains(wrong, "keep_near.distance"));
}

TEST_CASE("a plugin that does not fit is refused by name", "[installed]") {
  const Installed& here = installed();
  const auto refused = [&here](const fs::path& plugin, const std::string& why) {
    const CommandResult wrong = here.posevote("nodes --plugin '" + plugin.string() + "'");
    CHECK(wrong.status == 2);
    CHECK(contains(wrong, plugin.string() + ": "));
    CHECK(contains(wrong, why));
  };
  refused("nowhere.so", "no such file");
  refused(here.folder.write("text.so", "not a library"), "");
  const fs::path other = here.build("plugin", "other_abi", "-DOTHER_ABI=ON") / "libkeep_near.so";
  refused(other, "built for another version of posevote");
  // One file loaded twice is one plugin; a copy of it is another with the same names.
  const fs::path plugin = here.build("plugin", "twice") / "libkeep_near.so";
  CHECK(
      here.posevote("nodes --plugin " + plugin.string() + " --plugin " + plugin.string()).status ==
      0);
  fs::copy_file(plugin, here.folder / "copy.so");
  const CommandResult taken =
      here.posevote("nodes --plugin " + plugin.string() + " --plugin copy.so");
  CHECK(taken.status == 2);
  CHECK(contains(taken, "'keep_near' is taken"));
}

TEST_CASE("the Python module finds a part", "[installed]") {
  const Installed& here = installed();
  if (!fs::exists(here.prefix / "lib/python3/dist-packages/posevote")) {
    WARN("skipped: built without the Python module");
    return;
  }
  const CommandResult found =
      here.run("PYTHONPATH='" + (here.prefix / "lib/python3/dist-packages").string() + "' " +
               POSEVOTE_PYTHON + " '" + (kExamples / "python/find_part.py").string() + "'");
  INFO(found.output);
  CHECK(found.status == 0);
  CHECK(found.output.ends_with("fine\n"));
}

}  // namespace posevote::installed_test
