// SPDX-License-Identifier: BSD-3-Clause
// The Debian packages, unpacked into an empty folder one after the other. tools/clean_root installs
// them into a clean Debian.
#include <filesystem>

#include "tests/installed/shell.hpp"

namespace posevote::packages_test {

using namespace posevote::test;
namespace fs = std::filesystem;

namespace {

const fs::path kExamples = fs::path(POSEVOTE_SOURCE_DIR) / "tests/installed";

struct Packages {
  TemporaryFolder folder;
  CommandResult made = run_in(
      folder, "cpack --config '" POSEVOTE_BUILD_DIR "/CPackConfig.cmake' -B \"$PWD/packages\"");

  CommandResult run(const std::string& command) const { return run_in(folder, command); }
  CommandResult posevote(const std::string& arguments) const {
    return run("root/usr/bin/posevote " + arguments);
  }
  bool has(const std::string& package) const { return deb(package) != ""; }
  CommandResult unpack(const std::string& package) const {
    return run("dpkg-deb -x '" + deb(package) + "' root && dpkg-deb -f '" + deb(package) +
               "' Depends");
  }

 private:
  std::string deb(const std::string& package) const {
    for (const auto& entry : fs::directory_iterator(folder / "packages"))
      if (entry.path().filename().string().starts_with(package + "_")) return entry.path().string();
    return "";
  }
};

}  // namespace

TEST_CASE("the packages hold what runs, and depend on little", "[installed]") {
  const Packages here;
  if (here.run("command -v dpkg-deb dpkg-shlibdeps").status != 0) {
    WARN("skipped: no dpkg-deb and dpkg-shlibdeps (dpkg-dev)");
    return;
  }
  INFO(here.made.output);
  REQUIRE(here.made.status == 0);

  const CommandResult runtime = here.unpack("posevote");
  CHECK(contains(runtime, "libtbb12"));
  for (const char* heavy : {"libpcl", "libopencv", "libvtk", "python", "-dev"})
    CHECK_FALSE(contains(runtime, heavy));
  CHECK(contains(here.posevote("--version"), "posevote 0."));
  CHECK(contains(here.posevote("nodes describe_shot"),
                 "it comes with the package posevote-pcl, which is not installed"));
  here.folder.write("spec.yaml",
                    "seed: 5\nmodels:\n  - {shape: figure, seed: 3, size: 0.2}\n"
                    "scenes:\n  - {sensor: rgbd, objects: [1], clutter: 1}\n");
  CHECK(here.posevote("simulate spec.yaml --out data").status == 0);
  CHECK(contains(here.posevote("run --models data/models --scenes data/scans --out out"),
                 "1 frames answered, 0 failed"));
  CHECK_FALSE(fs::exists(here.folder / "root/usr/include"));
  for (const char* file : {"man/man1/posevote.1", "bash-completion/completions/posevote",
                           "doc/posevote/copyright", "posevote/configs/uwa.yaml"})
    CHECK(fs::exists(here.folder / "root/usr/share" / file));

  CHECK(contains(here.unpack("posevote-pcl"), "libpcl-features"));
  CHECK(contains(here.posevote("nodes describe_shot"), "SHOT"));

  CHECK(contains(here.unpack("posevote-dev"), "posevote (= "));
  const CommandResult built =
      here.run("cmake -S '" + (kExamples / "cpp").string() +
               "' -B cpp -DCMAKE_PREFIX_PATH=$PWD/root/usr && cmake --build cpp && cpp/find_part");
  CHECK(contains(built, "box: confidence"));

  if (!here.has("python3-posevote")) {
    WARN("skipped: built without the Python module");
    return;
  }
  CHECK(contains(here.unpack("python3-posevote"), "python3-numpy"));
  const CommandResult found =
      here.run("PYTHONPATH=root/usr/lib/python3/dist-packages " + std::string(POSEVOTE_PYTHON) +
               " '" + (kExamples / "python/find_part.py").string() + "'");
  INFO(found.output);
  CHECK(found.status == 0);
}

TEST_CASE("pip installs the module with all that it needs", "[installed]") {
  const TemporaryFolder folder;
  const std::string python = POSEVOTE_PYTHON;
  if (run_in(folder, python + " -c 'import setuptools, wheel, venv, pip'").status != 0) {
    WARN("skipped: no pip, setuptools, wheel or venv for " + python);
    return;
  }
  if (!fs::exists(POSEVOTE_BUILD_DIR "/lib/python3/dist-packages/posevote")) {
    WARN("skipped: built without the Python module");
    return;
  }
  const CommandResult installed = run_in(
      folder, python + " -m venv --system-site-packages --without-pip venv && POSEVOTE_BUILD='" +
                  POSEVOTE_BUILD_DIR +
                  "' venv/bin/python -m pip install --no-build-isolation --no-index '" +
                  POSEVOTE_SOURCE_DIR + "/tools/python'");
  INFO(installed.output);
  REQUIRE(installed.status == 0);
  const CommandResult found =
      run_in(folder, "venv/bin/python '" + (kExamples / "python/find_part.py").string() + "'");
  INFO(found.output);
  CHECK(found.status == 0);
  // All from the environment; stubs and docstrings with it.
  const CommandResult facts = run_in(folder, R"(venv/bin/python - <<'END'
import pathlib, posevote
home = pathlib.Path(posevote.__file__).parent
assert "venv" in home.parts, home
maps = open("/proc/self/maps").read()
assert all("/venv/" in line for line in maps.splitlines() if "libposevote.so" in line), maps
assert (home / "py.typed").exists() and (home / "__init__.pyi").exists()
assert "detect" in posevote.Recognizer.detect.__doc__ and posevote.Recognizer.__doc__
print("fine")
END
)");
  CHECK(contains(facts, "fine\n"));
}

}  // namespace posevote::packages_test
