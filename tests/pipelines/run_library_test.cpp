// SPDX-License-Identifier: BSD-3-Clause
// `posevote run` on what was trained before: libraries and caches.
#include "tests/pipelines/run_world.hpp"

namespace posevote::run_library_test {

using namespace posevote::test;

TEST_CASE("a stale, a damaged and an unwritable cache", "[run]") {
  const World& w = world();
  const std::string cache = " --cache " + (w.folder / "own-cache").string();
  REQUIRE(w.run("cache1", w.scans_argument() + cache).status == 0);
  std::vector<fs::path> files(fs::directory_iterator(w.folder / "own-cache"), {});
  REQUIRE(files.size() == 1);
  REQUIRE(w.run("cache2", w.scans_argument() + cache + " --set describe_models.radius=15").status ==
          0);
  CHECK(std::distance(fs::directory_iterator(w.folder / "own-cache"), {}) == 2);
  std::string bytes = read_text(files[0]);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(files[0], std::ios::binary) << bytes;
  const CommandResult damaged = w.run("cache3", w.scans_argument() + cache);
  CHECK(damaged.status == 0);
  CHECK(damaged.output.find("trained anew") != std::string::npos);
  CHECK(csv("cache3") == csv("cache1"));
  const CommandResult unwritable = w.run("cache4", w.scans_argument() + " --cache /proc/nowhere");
  CHECK(unwritable.status == 0);
  CHECK(unwritable.output.find("not cached") != std::string::npos);
}

TEST_CASE("what another build trained is not taken from the cache", "[run]") {
  const World& w = world();
  const fs::path here = fs::path(POSEVOTE_BINARY).parent_path(), there = w.folder / "other-build";
  const fs::path other = there / "posevote";
  fs::create_directories(there / "lib");
  fs::copy_file(POSEVOTE_BINARY, other);
  for (const auto& entry : fs::directory_iterator(here / "lib"))
    if (entry.path().filename().string().starts_with("libposevote.so") && !entry.is_symlink()) {
      const fs::path library = there / "lib" / entry.path().filename();
      fs::copy_file(entry.path(), library);
      std::ofstream(library, std::ios::binary | std::ios::app) << '\n';
    }
  fs::copy(here / "lib", there / "lib",
           fs::copy_options::recursive | fs::copy_options::skip_existing |
               fs::copy_options::copy_symlinks);
  fs::copy(here / "share", there / "share",
           fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  const std::string run = "run demo --models " + w.models.string() + " " + w.scans_argument() +
                          " --cache " + (w.folder / "shared-cache").string() + " --out ";
  const auto libraries_after = [&](const std::string& out, const std::string& program) {
    REQUIRE(run_posevote(w.folder, run + (w.folder / out).string(), program).status == 0);
    return std::distance(fs::directory_iterator(w.folder / "shared-cache"), {});
  };
  CHECK(libraries_after("build1", POSEVOTE_BINARY) == 1);
  CHECK(libraries_after("build2", POSEVOTE_BINARY) == 1);
  CHECK(libraries_after("build3", other) == 2);
}

TEST_CASE("a trained library, and one that was trained otherwise", "[run]") {
  const World& w = world();
  const std::string library = (w.folder / "two.library").string();
  const CommandResult trained =
      run_posevote(w.folder, "train demo --models " + w.models.string() + " --out " + library);
  INFO(trained.output);
  REQUIRE(trained.status == 0);
  const std::string run = "run demo --library " + library + " " + w.scans_argument() + " --out ";
  REQUIRE(run_posevote(w.folder, run + (w.folder / "lib1").string()).status == 0);
  REQUIRE(w.run("lib2", w.scans_argument()).status == 0);
  CHECK(csv("lib1") == csv("lib2"));
  const CommandResult other = run_posevote(
      w.folder, run + (w.folder / "lib3").string() + " --set describe_models.radius=15");
  CHECK(other.status == 2);
  CHECK(other.output.find("two.library") != std::string::npos);
}

TEST_CASE("a new library in the cache takes away what nobody has used for a month", "[run]") {
  const World& w = world();
  const TemporaryFolder folder;
  const std::string key(32, 'a'), other(32, 'b'), half = ".library.1a2b.tmp";
  const auto put = [&folder](const std::string& name, int days) {
    const fs::path file = folder.write(name, "x");
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24 * days + 1));
    return file;
  };
  const fs::path old = put(key + ".library", 30), torn = put(key + half, 1);
  const fs::path used = put(other + ".library", 29), fresh = put(other + half, 0);
  const fs::path mine = put("mine.library", 99), notes = put(key + ".library.txt", 99);
  const CommandResult run = w.run("tidy", "--scenes " + (w.scans / "000001.ply").string() +
                                              " --cache " + folder.path().string());
  INFO(run.output);
  REQUIRE(run.status == 0);
  for (const fs::path& gone : {old, torn}) CHECK_FALSE(fs::exists(gone));
  for (const fs::path& kept : {used, fresh, mine, notes}) CHECK(fs::exists(kept));
}

}  // namespace posevote::run_library_test
