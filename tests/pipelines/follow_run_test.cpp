// SPDX-License-Identifier: BSD-3-Clause
// `posevote run --follow`, as a user would.
#include <thread>

#include "tests/pipelines/run_world.hpp"

namespace posevote::follow_run_test {

using namespace posevote::test;
using Catch::Contains;

TEST_CASE("scans are answered as they come, until somebody says stop", "[follow]") {
  const fs::path folder = world().folder / "arriving";
  fs::create_directories(folder);
  const std::vector<std::string> scans = {"000000.ply", "000001.ply", "000002.ply"};
  // Before the program starts: it would inherit a file that is open to write, and wait for it to be
  // closed.
  for (const std::string& scan : scans)
    fs::copy_file(world().scans / scan, folder / (scan + ".part"));
  std::thread writer([&] {
    for (const std::string& scan : scans) {
      fs::rename(folder / (scan + ".part"), folder / scan);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    std::ofstream(folder / "stop").flush();
  });
  const CommandResult followed = world().run("followed", "--follow --scenes " + folder.string());
  writer.join();
  INFO(followed.output);
  CHECK(followed.status == 0);
  CHECK_THAT(followed.output, Contains("latency ") && Contains("3 frames answered, 0 failed"));
  const nlohmann::json answered = frames("followed");
  REQUIRE(answered.size() == 3);
  REQUIRE(world().run("listed", world().scans_argument()).status == 0);
  CHECK(csv("followed") == csv("listed"));
}

TEST_CASE("what --follow does not go with is said", "[follow]") {
  const auto refused = [](const std::string& more) {
    const CommandResult run = world().run("refused", more);
    CHECK(run.status == 2);
    return run.output;
  };
  CHECK_THAT(refused("--follow --resume " + world().scans_argument()), Contains("--follow"));
  CHECK_THAT(refused("--real-time " + world().scans_argument()), Contains("--follow"));
  CHECK_THAT(refused("--follow --scenes a b"), Contains("--follow expects --scenes FOLDER"));
}

TEST_CASE("a scan that would take too much memory fails by name", "[follow]") {
  const CommandResult run = world().run("too_large", "--memory 1MB " + world().scans_argument());
  INFO(run.output);
  CHECK(run.status == 1);
  CHECK_THAT(run.output, Contains("000000.ply: load_scene: has ") &&
                             Contains("more than the 16384 that memory is granted for"));
}

}  // namespace posevote::follow_run_test
