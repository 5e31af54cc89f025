// SPDX-License-Identifier: BSD-3-Clause
// A batch in parts: shards that are merged, runs that are killed, and what `status` says of both.
#include "tests/pipelines/run_world.hpp"
#include "tools/manifest/manifest.hpp"

namespace posevote::batch_test {

using namespace posevote::test;
using Catch::Contains;

namespace {

/// Seven scans, of which one is broken, one run over all and one for each of three shards.
struct Batch {
  TemporaryFolder folder;
  fs::path scans = folder / "scans";
  std::string models = " --models " + world().models.string();

  Batch() {
    fs::create_directories(scans);
    for (int i = 0; i < 7; ++i)
      fs::copy(world().scans / ("00000" + std::to_string(i % 3) + ".ply"),
               scans / ("scan" + std::to_string(i) + ".ply"));
    folder.write("scans/scan4.ply", "broken");
    REQUIRE(run("whole", "").status == 1);
    for (int i = 1; i <= 3; ++i) {
      const std::string part = std::to_string(i);
      CHECK(run("part" + part, "--shard " + part + "/3").status == (i == 2 ? 1 : 0));
    }
  }

  CommandResult run(const std::string& out, const std::string& more) const {
    return run_posevote(folder, "run demo" + models + " --scenes " + scans.string() + " --out " +
                                    (folder / out).string() + " --quiet --cache " +
                                    (world().folder / "cache/posevote").string() +
                                    " --set write_overlay.every=0 " + more);
  }
  CommandResult merge(const std::string& parts, const std::string& out) const {
    std::string folders;
    for (const char part : parts)
      folders += (folder / ("part" + std::string(1, part))).string() + " ";
    return run_posevote(folder, "merge " + folders + "--out " + (folder / out).string());
  }
  nlohmann::json status(const std::string& out) const {
    const CommandResult said = run_posevote(folder, "status --json " + (folder / out).string());
    INFO(said.output);
    REQUIRE(said.status == 0);
    return nlohmann::json::parse(said.output)["runs"][0];
  }
  std::string rows(const std::string& out) const {
    return std::regex_replace(read_text(folder / out / "results.csv"), std::regex(",[^,\n]*\n"),
                              "\n");
  }
  /// Frames without times, and without the checksums of their records.
  nlohmann::json frames(const std::string& out) const {
    nlohmann::json results = read_json(folder / out / "results.json");
    for (nlohmann::json& frame : results["frames"]) {
      for (const char* key : {"seconds", "latency_s", "stages", "checksum"}) frame.erase(key);
      for (const char* list : {"detections", "rejected"})
        for (nlohmann::json& detection : frame[list]) detection.erase("seconds");
    }
    return results["frames"];
  }
  void copy(const std::string& from, const std::string& to) const {
    fs::remove_all(folder / to);
    fs::copy(folder / from, folder / to, fs::copy_options::recursive);
  }
};

const Batch& batch() {
  static const Batch the_batch;
  return the_batch;
}

}  // namespace

TEST_CASE("merged shards are what one run writes, but for times", "[merge]") {
  const Batch& b = batch();
  const CommandResult merged = b.merge("312", "merged");
  INFO(merged.output);
  REQUIRE(merged.status == 0);
  CHECK_THAT(merged.output, Contains("6 frames answered, 1 failed"));
  CHECK(b.rows("merged") == b.rows("whole"));
  CHECK(b.frames("merged") == b.frames("whole"));
  for (const char* file : {"detections.csv", "failures.json", "effective.yaml"})
    CHECK(read_text(b.folder / "merged" / file) == read_text(b.folder / "whole" / file));
  for (int i = 0; i < 7; ++i) {
    const std::string picture = "pictures/scan" + std::to_string(i) + ".png";
    CHECK(fs::exists(b.folder / "merged" / picture) == fs::exists(b.folder / "whole" / picture));
  }
  CHECK(fs::exists(b.folder / "merged/pictures/scan6.png"));
  // It is a run like any other: the scan that failed is mended.
  CHECK(b.status("merged")["state"] == "done");
  const CommandResult resumed = b.run("merged", "--resume");
  CHECK_THAT(resumed.output, Contains("0 frames answered, 1 failed"));
  CHECK(b.rows("merged") == b.rows("whole"));
}

TEST_CASE("merge refuses what is missing, twice or of another run, by name", "[merge]") {
  const Batch& b = batch();
  const auto refuses = [&b](const std::string& parts, const std::string& why) {
    const CommandResult refused = b.merge(parts, "refused");
    INFO(refused.output);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.output, Contains(why));
    CHECK_FALSE(fs::exists(b.folder / "refused/results.csv"));
  };
  refuses("12", "2 of 7 frames are in none of the folders: 2 (scan2), 5 (scan5)");
  refuses("1232", "part2/results.json: frame 1 (scan1) is in ");
  refuses("129", "part9: no run.json in it");
  REQUIRE(b.run("part4", "--shard 3/3 --seed 5").status == 0);
  refuses("124", "part4: is of another run than ");
  refuses("124", "--seed was 0, now 5");
  b.copy("part3", "part5");
  Manifest manifest = read_manifest(b.folder / "part5").value();
  manifest.scans[6].file.path = "scans/another.ply";
  write_manifest(b.folder / "part5", manifest);
  refuses("125", "part5: is of another batch than ");
  manifest.scans.pop_back();
  write_manifest(b.folder / "part5", manifest);
  refuses("125", "part5: is of a batch of 6 scans");
  b.copy("part3", "part6");
  std::string results = read_text(b.folder / "part6/results.json");
  results.replace(results.find("\"scan2\""), 7, "\"scan3\"");
  b.folder.write("part6/results.json", results);
  refuses("126", "part6/results.json: 1 damaged records");
  CHECK_THAT(b.merge("123", "part1").output, Contains("is one of the parts"));
  CHECK_THAT(b.merge("123", "whole").output, Contains("holds another run"));
}

TEST_CASE("status tells what is done, failed and left, and who is at it", "[status]") {
  const Batch& b = batch();
  const nlohmann::json whole = b.status("whole");
  INFO(whole.dump());
  CHECK(whole["answered"] == 6);
  CHECK(whole["failed"] == 1);
  CHECK(whole["left"] == 0);
  CHECK(whole["state"] == "done");
  CHECK(whole["frames_per_s"] > 0.01);
  CHECK(b.status("part1")["answered"] == 3);  // of its own shard
  CHECK(b.status("part1")["left"] == 0);
  REQUIRE(b.run("tables", "--format csv").status == 1);
  const nlohmann::json tables = b.status("tables");
  CHECK(tables["answered"] == 6);
  CHECK(tables["failed"] == 1);
  CHECK(tables["left"] == 0);
  CHECK(tables["frames_per_s"] > 0.01);
  const CommandResult several = run_posevote(
      b.folder, "status " + (b.folder / "part1").string() + " " + (b.folder / "part2").string());
  CHECK_THAT(several.output, Contains("all            4 answered      1 failed       0 left"));
  const CommandResult none = run_posevote(b.folder, "status " + b.scans.string());
  CHECK(none.status == 2);
  CHECK_THAT(none.output, Contains("no run.json in it"));
}

TEST_CASE("a batch that is killed at any moment is resumed to the same results", "[status]") {
  const TemporaryFolder folder;
  const std::string script = POSEVOTE_SOURCE_DIR "/tests/pipelines/kill_batch.py";
  const CommandResult killed =
      run_posevote(folder,
                   script + " " + POSEVOTE_BINARY + " --models " + world().models.string() +
                       " --scans " + (world().scans / "000001.ply").string() + " --work " +
                       (folder / "work").string() + " --count 10 --kills 6",
                   POSEVOTE_PYTHON);
  INFO(killed.output);
  CHECK(killed.status == 0);
  CHECK_THAT(killed.output, Contains("killed 6 times"));
}

}  // namespace posevote::batch_test
