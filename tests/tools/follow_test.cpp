// SPDX-License-Identifier: BSD-3-Clause
// Scans that arrive in a folder while it is watched.
#include <catch2/catch.hpp>
#include <fstream>
#include <thread>

#include "tests/support/temporary_folder.hpp"
#include "tools/quantiles.hpp"
#include "tools/stream/followed_scans.hpp"

namespace posevote::follow_test {

using namespace posevote::test;
using namespace std::chrono_literals;
using stream::FollowedScans;
using stream::WatchedFolder;

namespace {

constexpr auto kLong = 5000ms;  ///< for what comes
constexpr auto kShort = 150ms;  ///< for what does not

std::vector<std::string> names(const std::vector<stream::Arrival>& arrivals) {
  std::vector<std::string> names;
  for (const stream::Arrival& one : arrivals) names.push_back(one.file.filename().string());
  return names;
}

using Names = std::vector<std::string>;
const std::atomic<bool> kNever = false;

/// "scan0.ply" ... beside each other, then `stop`.
void write_scans(const TemporaryFolder& folder, int count, std::chrono::milliseconds pause) {
  for (int i = 0; i < count; ++i) {
    std::this_thread::sleep_for(pause);
    folder.write("scan" + std::to_string(i) + ".ply", "ply");
  }
  folder.write("stop", "");
}

Names names_of_all(FollowedScans& scans, std::chrono::milliseconds work) {
  Names all;
  while (const auto scan = scans.next()) {
    all.push_back(scan->entry.name);
    std::this_thread::sleep_for(work);
    scans.answered(scan->since);
  }
  return all;
}

}  // namespace

TEST_CASE("a file arrives when its writer has closed it, not before", "[follow]") {
  const TemporaryFolder folder;
  WatchedFolder watched(folder.path());
  std::ofstream file(folder / "a.ply");
  file << "half of it" << std::flush;
  CHECK(watched.take(kShort).empty());
  file << "the rest";
  file.close();
  CHECK(names(watched.take(kLong)) == Names{"a.ply"});
  CHECK(watched.take(kShort).empty());
}

TEST_CASE("a file that is moved in arrives; others are no scans", "[follow]") {
  const TemporaryFolder folder, elsewhere;
  WatchedFolder watched(folder.path());
  folder.write(".hidden.ply", "");
  folder.write("notes.txt", "");
  folder.write("a.ply.part", "");
  std::filesystem::create_directory(folder / "folder.ply");
  std::filesystem::rename(elsewhere.write("b.ply", ""), folder / "b.ply");
  CHECK(names(watched.take(kLong)) == Names{"b.ply"});
}

TEST_CASE("what is there already arrives in the order of names, unless it is being written",
          "[follow]") {
  const TemporaryFolder folder;
  folder.write("scan10.ply", "");
  folder.write("scan9.ply", "");
  std::ofstream open(folder / "scan1.ply");
  WatchedFolder watched(folder.path());
  CHECK(names(watched.take(kLong)) == Names{"scan9.ply", "scan10.ply"});
  open.close();
  CHECK(names(watched.take(kLong)) == Names{"scan1.ply"});
}

TEST_CASE("no more comes after `stop`, or when the folder goes", "[follow]") {
  auto folder = std::make_unique<TemporaryFolder>();
  {
    WatchedFolder watched(folder->path());
    CHECK(watched.ended().empty());
    folder->write("stop", "");
    watched.take(kLong);
    CHECK(watched.ended() == "stopped by " + (*folder / "stop").string());
  }
  std::filesystem::remove(*folder / "stop");
  WatchedFolder watched(folder->path());
  const std::string path = folder->path().string();
  folder.reset();
  watched.take(kLong);
  CHECK(watched.ended() == path + " is not there any more");
  CHECK_THROWS_WITH(WatchedFolder(path), Catch::Contains(path + ": cannot be watched"));
}

TEST_CASE("nothing is left out, however slowly it is taken", "[follow]") {
  const TemporaryFolder folder;
  FollowedScans scans(folder.path(), false, kNever);
  std::thread writer([&] { write_scans(folder, 12, 0ms); });
  const Names all = names_of_all(scans, 5ms);
  writer.join();
  REQUIRE(all.size() == 12);
  for (std::size_t i = 0; i < all.size(); ++i) CHECK(all[i] == "scan" + std::to_string(i));
  CHECK(scans.json()["left_out"] == 0);
  CHECK(scans.json()["behind"] > 0);
  CHECK(scans.latencies().size() == 12);
  CHECK(scans.json()["latency_s"]["p99"] >= scans.json()["latency_s"]["median"]);
  CHECK(scans.json()["latency_s"]["median"] > 0.005);
}

TEST_CASE("in real time the newest is taken and the others are counted", "[follow]") {
  const TemporaryFolder folder;
  FollowedScans scans(folder.path(), true, kNever);
  std::thread writer([&] { write_scans(folder, 30, 2ms); });
  const Names all = names_of_all(scans, 20ms);
  writer.join();
  CHECK(all.size() < 30);
  CHECK(all.back() == "scan29");
  CHECK(all.size() + scans.json()["left_out"].get<std::size_t>() == 30);
  CHECK(quantile(scans.latencies(), 1) < 0.5);
}

TEST_CASE("a writer who is slower than the reader loses nothing in real time", "[follow]") {
  const TemporaryFolder folder;
  FollowedScans scans(folder.path(), true, kNever);
  std::thread writer([&] { write_scans(folder, 5, 60ms); });
  CHECK(names_of_all(scans, 0ms).size() == 5);
  writer.join();
  CHECK(scans.json()["left_out"] == 0);
}

TEST_CASE("an interrupt ends the wait", "[follow]") {
  const TemporaryFolder folder;
  std::atomic<bool> interrupted = false;
  FollowedScans scans(folder.path(), false, interrupted);
  std::thread user([&] {
    std::this_thread::sleep_for(50ms);
    interrupted = true;
  });
  CHECK_FALSE(scans.next());
  user.join();
}

TEST_CASE("depth images are followed in depth/ with the camera beside it", "[follow]") {
  const TemporaryFolder folder;
  folder.write("camera.json", R"({"fx": 500, "fy": 500, "cx": 320, "cy": 240, "depth_scale": 1})");
  folder.write("depth/0.png", "");
  folder.write("depth/0.npy", "");
  FollowedScans scans(folder.path(), false, kNever);
  const auto first = scans.next(), second = scans.next();
  REQUIRE(first);
  REQUIRE(second);
  CHECK(first->entry.file.camera->fx == 500);
  CHECK(second->entry.name == "000001_0");  // names of frames differ
}

TEST_CASE("a recording that is complete is not followed", "[follow]") {
  const TemporaryFolder folder;
  folder.write("depth.txt", "0.1 depth/0.png\n");
  CHECK_THROWS_WITH(FollowedScans(folder.path(), false, kNever), Catch::Contains("TUM RGB-D"));
  CHECK_THROWS_WITH(FollowedScans(folder / "none", false, kNever),
                    Catch::Contains("expected a folder"));
}

}  // namespace posevote::follow_test
