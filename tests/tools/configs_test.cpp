// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/support/command.hpp"

namespace posevote::configs_test {

using namespace posevote::test;
using Catch::Contains;

TEST_CASE("configs and pipelines are listed, with what they are for", "[configs]") {
  const TemporaryFolder folder;
  const CommandResult text = run_posevote(folder, "configs");
  REQUIRE(text.status == 0);
  CHECK_THAT(text.output, Contains("Any data set in BOP layout") && Contains("hough3d") &&
                              Contains("demo_scenes") && Contains("They lie in /"));
  const CommandResult json = run_posevote(folder, "configs --json");
  REQUIRE(json.status == 0);
  bool has_default = false;
  for (const auto& named : nlohmann::json::parse(json.output)) {
    INFO(named.dump());
    CHECK(std::filesystem::exists(named["file"].get<std::string>()));
    CHECK(named["purpose"].get<std::string>().size() > 5);
    has_default = has_default || (named["name"] == "default" && named["kind"] == "config");
  }
  CHECK(has_default);
}

TEST_CASE("check and graph take another pipeline", "[configs]") {
  const TemporaryFolder folder;
  CHECK(run_posevote(folder, "check demo --pipeline ransac").status == 0);
  const CommandResult wrong = run_posevote(folder, "check demo --pipeline no_such");
  CHECK(wrong.status == 2);
  CHECK_THAT(wrong.output, Contains("no pipeline is called 'no_such'"));
  const CommandResult drawn = run_posevote(folder, "graph demo --pipeline ransac");
  CHECK_THAT(drawn.output, Contains("\"cluster_ransac\"") && !Contains("cast_pairs"));
  CHECK_THAT(run_posevote(folder, "check demo --flat --pipeline ransac").output,
             Contains("ransac:") && !Contains("cast_pairs:"));
}

TEST_CASE("no descriptor takes a radius that its library cannot count with", "[configs]") {
  const TemporaryFolder folder;
  const CommandResult run = run_posevote(
      folder,
      "check default --set describe_scene.node=describe_usc --set describe_scene.radius=1e30 "
      "--set describe_models.node=describe_usc --set describe_models.radius=1e30");
  CHECK(run.status == 2);
  CHECK_THAT(run.output,
             Contains("describe_models.radius: '1e30' is not allowed, must be in [0.1, 200]"));
}

}  // namespace posevote::configs_test
