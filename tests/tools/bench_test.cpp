// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bench/bench.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"

namespace posevote::bench_test {

using posevote::test::TemporaryFolder;

TEST_CASE("two benches are compared method by method and stage by stage", "[bench]") {
  const TemporaryFolder folder;
  const std::string before = folder.write(
      "old.json",
      R"({"posevote": {"train_s": 1, "online_s": 0.5, "stages_s": {"match": 0.2, "gone": 1}},
                      "ransac": {"train_s": 1, "online_s": 3, "stages_s": {}}})");
  const std::string after = folder.write(
      "new.json", R"({"posevote": {"train_s": 2, "online_s": 0.25, "stages_s": {"match": 0.3}}})");
  const std::string text = to_table(compare_benches(before, after));
  INFO(text);
  CHECK(text.find("posevote                              500.0      250.0     0.50") !=
        std::string::npos);
  CHECK(text.find("  match                               200.0      300.0     1.50") !=
        std::string::npos);
  CHECK(text.find("posevote training                    1000.0     2000.0     2.00") !=
        std::string::npos);
  CHECK(text.find("gone") == std::string::npos);
  CHECK(text.find("ransac") == std::string::npos);
}

TEST_CASE("what is no bench is refused by name", "[bench]") {
  const TemporaryFolder folder;
  const std::string wrong = folder.write("wrong.json", "{\"a\": 1}");
  CHECK_THROWS_WITH(compare_benches(wrong, wrong), Catch::Contains("wrong.json"));
  CHECK_THROWS_WITH(compare_benches("nowhere.json", wrong), Catch::Contains("nowhere.json"));
}

}  // namespace posevote::bench_test
