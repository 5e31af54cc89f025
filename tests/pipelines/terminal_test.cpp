// SPDX-License-Identifier: BSD-3-Clause
// What `posevote run` shows: one live line on a terminal, plain lines in a log, and after Ctrl-C how
// to go on.
#include "tests/support/terminal.hpp"

#include "tests/pipelines/run_world.hpp"

namespace posevote::terminal_test {

using namespace posevote::test;
using Catch::Contains;

namespace {

/// `environment`: "NAME=VALUE " before the program.
std::string command(const std::string& out, const std::string& more,
                    const std::string& environment = "TERM=xterm ") {
  const World& w = world();
  return "XDG_CACHE_HOME='" + (w.folder / "cache").string() + "' " + environment + "'" +
         POSEVOTE_BINARY + "' run demo --models " + w.models.string() + " --out " +
         (w.folder / out).string() + " " + more;
}

/// One scan with one object.
std::string one_scan() { return "--scenes " + (world().scans / "000001.ply").string(); }

/// Many frames of one scan.
fs::path many_scans(int count) {
  const fs::path many = world().folder / ("many" + std::to_string(count));
  fs::create_directories(many);
  for (int i = 0; i < count; ++i)
    fs::create_symlink(world().scans / "000001.ply", many / (std::to_string(1000 + i) + ".ply"));
  return many;
}

}  // namespace

TEST_CASE("a terminal shows one live line, which is gone in the end", "[terminal]") {
  const std::string broken = world().folder.write("broken/0\x1b[31m.ply", "no");
  const CommandResult run =
      run_on_terminal(command("live", world().scans_argument() + " '" + broken + "'"));
  INFO(run.output);
  CHECK(run.status == 1);
  CHECK_THAT(run.output, Contains("\r\x1b[K[") && Contains("frames"));
  const std::string screen = screen_of(run.output);
  INFO(screen);
  CHECK_THAT(screen, Contains("[2/4] 000000.ply: 2 found (") &&
                         Contains("\x1b[31merror\x1b[0m: ") &&
                         Contains("3 frames answered, 1 failed; 4 found; results in"));
  CHECK_THAT(screen, !Contains("frames/s") && !Contains("left") && !Contains("mean ms"));
  CHECK_THAT(screen, Contains("0\\x1b[31m.ply: load_scene: "));
  CHECK_THAT(screen, !Contains("0\x1b[31m.ply"));

  const CommandResult plain =
      run_on_terminal(command("plain-live", one_scan(), "NO_COLOR=1 TERM=xterm "));
  CHECK_THAT(plain.output, Contains("\x1b[K") && !Contains("\x1b[3"));
  const CommandResult dumb = run_on_terminal(command("dumb-live", one_scan(), "TERM=dumb "));
  CHECK_THAT(dumb.output, Contains("found (") && !Contains("\x1b"));
}

TEST_CASE("a log holds plain lines; --quiet leaves the last, -v tells all", "[terminal]") {
  const World& w = world();
  const CommandResult log = w.run("log", one_scan());
  CHECK_THAT(log.output, Contains("[1/1] 000001.ply: 1 found (") && !Contains("\x1b"));
  CHECK_THAT(log.output, !Contains("mean ms") && !Contains("measured: "));
  const CommandResult verbose = w.run("verbose", one_scan() + " -v");
  CHECK_THAT(verbose.output, Contains("found (") && Contains("mean ms") &&
                                 Contains("segment_objects") && Contains("measured: ") &&
                                 Contains("noise_m"));
  const CommandResult quiet = w.run("quiet", one_scan() + " --quiet");
  CHECK(quiet.output ==
        "1 frames answered, 0 failed; 1 found; results in " + (w.folder / "quiet").string() + "\n");
  CHECK(w.run("both", one_scan() + " --quiet -v").status == 2);
}

TEST_CASE("after Ctrl-C: what is left, and the command that goes on", "[terminal]") {
  const World& w = world();
  const CommandResult run = run_on_terminal(
      "timeout --preserve-status --foreground -s INT 3 env " +
      command("stopped-by-hand", "--overwrite --threads 1 --scenes " + many_scans(300).string()));
  INFO(run.output);
  REQUIRE(run.status == 130);
  const std::string screen = screen_of(run.output);
  CHECK_THAT(screen,
             Contains(" of 300 frames are left; to go on:\n  ") && !Contains("Ctrl-C again"));
  const std::size_t done = frames("stopped-by-hand").size();
  CHECK_THAT(screen, Contains("interrupted: " + std::to_string(300 - done) + " of 300"));
  const std::size_t at = screen.find("to go on:\n  ") + 12;
  const std::string go_on = screen.substr(at, screen.find('\n', at) - at);
  CHECK_THAT(go_on, Contains(POSEVOTE_BINARY) && Contains("--resume") && !Contains("--overwrite"));
  // It does go on: the shell takes it as it stands; of a shard, so that it ends soon.
  const CommandResult resumed = run_on_terminal("XDG_CACHE_HOME='" + (w.folder / "cache").string() +
                                                "' TERM=dumb " + go_on + " --shard 300/300");
  INFO(resumed.output);
  CHECK(resumed.status == 0);
  CHECK(frames("stopped-by-hand").size() == done + (done < 300 ? 1 : 0));
}

TEST_CASE("Ctrl-C while models are prepared ends that soon", "[terminal]") {
  const World& w = world();
  const std::string models = (w.folder / "many_models").string();
  fs::create_directories(models);
  for (int i = 0; i < 40; ++i)
    fs::copy_file(w.models / "obj_000001.ply", models + "/part" + std::to_string(100 + i) + ".ply",
                  fs::copy_options::skip_existing);
  const fs::path out = w.folder / "prepared";
  const CommandResult run = run_on_terminal(
      "XDG_CACHE_HOME='" + out.string() +
      "' TERM=dumb timeout --preserve-status --foreground -s INT 1 '" + POSEVOTE_BINARY +
      "' run demo --models " + models + " --out " + (out / "out").string() + " " + one_scan());
  INFO(run.output);
  CHECK(run.status == 130);
  CHECK_THAT(screen_of(run.output), Contains("interrupted: 1 of 1 frames are left; to go on:\n  "));
  CHECK(fs::exists(out / "posevote"));    // it had begun
  CHECK(fs::is_empty(out / "posevote"));  // and made no library
  CHECK_FALSE(fs::exists(out / "out"));
}

TEST_CASE("closed standard output and input take no file's place", "[terminal]") {
  const World& w = world();
  REQUIRE(w.run("open", one_scan()).status == 0);
  const std::string closed = command("closed", one_scan()) + " <&- >&- 2>&-";
  REQUIRE(std::system(closed.c_str()) == 0);
  CHECK(csv("closed") == csv("open"));
  CHECK_THAT(read_text(w.folder / "closed/results.csv"), !Contains("found"));
}

TEST_CASE("a link to itself fails its own frame, and foreign files are told", "[terminal]") {
  const World& w = world();
  const fs::path mixed = w.folder / "links";
  fs::create_directories(mixed);
  fs::create_symlink(w.scans / "000001.ply", mixed / "a.ply");
  fs::create_symlink("b.ply", mixed / "b.ply");
  for (const char* name : {"c.tiff", "d.tiff", "e.xyz", "notes.txt", "a.json"})
    w.folder.write(std::string("links/") + name, "");
  const CommandResult run = w.run("links-out", "--scenes " + mixed.string());
  INFO(run.output);
  CHECK(run.status == 1);
  CHECK(frames("links-out").size() == 1);
  CHECK_THAT(run.output, Contains("b.ply: load_scene: Too many levels of symbolic links"));
  CHECK_THAT(run.output,
             Contains("2 files .tiff, 1 file .xyz passed over; .") && Contains(" files are read"));
  CHECK_THAT(run.output, !Contains(".txt") && !Contains(".json passed"));
}

}  // namespace posevote::terminal_test
