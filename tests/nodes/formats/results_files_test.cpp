// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/results_files.hpp"

#include <catch2/catch.hpp>

#include "nodes/formats/scan_hash.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::results_files_test {

using Catch::Contains;
using posevote::test::read_text;
using posevote::test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

nlohmann::json json(const fs::path& file) { return nlohmann::json::parse(read_text(file)); }

/// A folder with three scans, and a run on them.
struct SmallRun {
  TemporaryFolder folder;
  fs::path out = folder / "out";
  formats::Batch batch;

  SmallRun() {
    for (const std::size_t i : {0U, 1U, 2U}) {
      const std::string file = folder.write("scan" + std::to_string(i) + ".ply", std::to_string(i));
      batch.scans[i] = {file, 0, static_cast<int>(i), Camera{500, 500, 320, 240, 1}};
      batch.mine.insert(i);
    }
    formats::begin_results(out, batch);
  }

  formats::FrameReport report(std::size_t number) const {
    const SceneFile& scan = batch.scans.at(number);
    formats::FrameReport frame{number, scan, 1.25, {}, "scan" + std::to_string(number)};
    frame.scan_hash = formats::hash_scan(scan);
    return frame;
  }

  void answer(const std::vector<std::size_t>& numbers) const {
    formats::ResultsWriter writer(out, batch.formats);
    for (const std::size_t number : numbers) writer.write(report(number), one_chef(), {});
  }
  void fail(std::size_t number) const {
    formats::ResultsWriter(out, batch.formats)
        .write({number, batch.scans.at(number).path, "load_scene", "empty"});
  }

  static Detections one_chef() {
    Detection found;
    found.obj_id = 7;
    found.model = "chef";
    return {{found}};
  }

  std::set<std::size_t> resume() const { return formats::resume_results(out, batch).frames; }
  std::string table() const { return read_text(out / "results.csv"); }

  /// What a run is that was never disturbed.
  static std::string whole_table() {
    const SmallRun run;
    run.answer({0, 1, 2});
    return run.table();
  }
};

using Frames = std::set<std::size_t>;

}  // namespace

TEST_CASE("another run's folder is not written over", "[write]") {
  const SmallRun run;
  CHECK_THROWS_AS(formats::begin_results(run.out), std::invalid_argument);
}

TEST_CASE("only the formats that are asked for are written; without json none is resumed",
          "[write]") {
  SmallRun run;
  const auto begin_anew = [&run](const std::vector<std::string>& formats) {
    fs::remove_all(run.out);
    run.batch.formats = formats;
    formats::begin_results(run.out, run.batch);
    run.answer({0});
  };
  begin_anew({"csv"});
  CHECK_THAT(read_text(run.out / "detections.csv"), Contains("chef"));
  CHECK_FALSE(fs::exists(run.out / "results.json"));
  CHECK_FALSE(fs::exists(run.out / "results.csv"));
  CHECK(json(run.out / "failures.json").empty());
  CHECK_THROWS_WITH(run.resume(), Contains("without results.json"));
  formats::finish_results(run.out, run.batch.formats);
  CHECK_THAT(read_text(run.out / "detections.csv"), Contains("chef"));  // untouched
  // With json, any table is made anew from it.
  begin_anew({"json", "csv"});
  const std::string table = read_text(run.out / "detections.csv");
  std::ofstream(run.out / "detections.csv", std::ios::app) << "half a ro";
  CHECK(run.resume() == Frames{0});
  CHECK(read_text(run.out / "detections.csv") == table);
  CHECK_FALSE(fs::exists(run.out / "results.csv"));
}

TEST_CASE("resuming keeps answered frames and drops what a killed run left half written",
          "[write]") {
  const SmallRun run;
  run.answer({0, 1});
  run.fail(2);
  std::ofstream(run.out / "results.csv", std::ios::app) << "0,4,7,0.5\n0,5";
  std::ofstream(run.out / "results.json", std::ios::app) << "{\"frame\": 5, \"fi";
  CHECK(run.resume() == Frames{0, 1});
  run.answer({2});
  CHECK(run.table() == SmallRun::whole_table());
  CHECK(json(run.out / "results.json")["frames"].size() == 3);
  CHECK(json(run.out / "failures.json").empty());
}

TEST_CASE("rows come in the order of the scans, whatever was answered first", "[write]") {
  const SmallRun run;
  run.answer({0, 2});
  run.fail(1);
  CHECK(run.resume() == Frames{0, 2});
  run.answer({1});
  CHECK(run.table() != SmallRun::whole_table());
  formats::finish_results(run.out, run.batch.formats);
  CHECK(run.table() == SmallRun::whole_table());
  const nlohmann::json results = json(run.out / "results.json");
  REQUIRE(results["frames"].size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(results["frames"][i]["frame"] == i);
  CHECK(results.contains("nodes"));
  CHECK(run.resume() == Frames{0, 1, 2});  // the checksums are those of what stands there
}

TEST_CASE("a flipped bit anywhere in a record is noticed, and its frame is done again", "[write]") {
  const SmallRun run;
  run.answer({0, 1, 2});
  const std::string sound = read_text(run.out / "results.json");
  const std::size_t begin = sound.find("{\"frame\":1"), end = sound.find('\n', begin);
  std::size_t noticed = 0, flips = 0;
  for (std::size_t at = begin; at < end; at += 7, ++flips) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 7)));
    std::ofstream(run.out / "results.json", std::ios::trunc) << damaged;
    const Frames answered = run.resume();
    CHECK(answered.contains(0));
    noticed += !answered.contains(1);
  }
  CHECK(flips > 50);
  CHECK(noticed == flips);
}

TEST_CASE("resuming refuses scans that have changed before it touches a file", "[write]") {
  SmallRun run;
  run.answer({0, 1});
  run.fail(2);
  fs::remove(run.out / "results.csv");
  const auto refuses = [&run](const std::string& why) {
    CHECK_THROWS_WITH(run.resume(), Contains("results.json: frame 1: ") && Contains(why));
    CHECK(json(run.out / "failures.json").size() == 1);
    CHECK_FALSE(fs::exists(run.out / "results.csv"));
  };
  const formats::Batch sound = run.batch;
  run.batch.scans[1].path = run.folder.write("other.ply", "1");
  refuses("was \"scan1.ply\", now it is \"other.ply\"");
  run.batch = sound;
  run.batch.scans[1].scene_id = 2;
  refuses("scan1.ply was scene_id 0, im_id 1, now it is scene_id 2, im_id 1");
  run.batch = sound;
  run.batch.scans[1].camera->fx = 501;
  refuses("the camera of ");
  run.batch = sound;
  run.batch.scans.erase(1);
  refuses("scan1.ply is not among them any more");
  run.batch = sound;
  run.folder.write("scan1.ply", "one");
  refuses("scan1.ply holds something else now");
  run.folder.write("scan1.ply", "1");
  run.folder.write("scan1.pose", "0 0 1");
  refuses("scan1.ply holds something else now");
  fs::remove(run.folder / "scan1.pose");
  // The same scan elsewhere is the same scan.
  fs::create_directories(run.folder / "moved");
  fs::rename(run.folder / "scan1.ply", run.folder / "moved/scan1.ply");
  run.batch.scans[1].path = run.folder / "moved/scan1.ply";
  CHECK(run.resume() == Frames{0, 1});
}

TEST_CASE("resuming one shard keeps the failures of the others", "[write]") {
  SmallRun run;
  run.fail(1);
  run.batch.mine = {0};
  run.resume();
  run.fail(0);
  const nlohmann::json failures = json(run.out / "failures.json");
  REQUIRE(failures.size() == 2);
  CHECK(failures[0]["frame"] == 1);
  run.batch.mine = {0, 1, 2};
  run.resume();
  CHECK(json(run.out / "failures.json").empty());
}

TEST_CASE("results that no run wrote are named, without the JSON library's words", "[write]") {
  const TemporaryFolder folder;
  folder.write("results.json", formats::record({{"frame", "one"}, {"im_id", 1}}) + "\n");
  CHECK_THROWS_WITH(
      formats::resume_results(folder.path(), {}),
      Contains("results.json: is not what a run wrote: ") && !Contains("json.exception"));
}

}  // namespace posevote::results_files_test
