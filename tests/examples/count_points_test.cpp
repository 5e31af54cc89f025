// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"
#include "tools/command_line.hpp"

namespace posevote::count_points_test {

TEST_CASE("a command registers itself and parses its own options", "[examples]") {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const auto& all = all_commands();
  const auto count = std::find_if(all.begin(), all.end(),
                                  [](const CommandEntry& entry) { return entry.name == "count"; });
  REQUIRE(count != all.end());
  CLI::App app;
  const std::function<int()> run = count->add(app);
  CHECK_THROWS_AS(app.parse(""), CLI::RequiredError);
  app.parse(file);
  CHECK(run() == 0);
  app.parse((folder / "none.off").string());
  CHECK_THROWS_WITH(run(), Catch::Contains("none.off: there is no such file"));
}

}  // namespace posevote::count_points_test
