// SPDX-License-Identifier: BSD-3-Clause
// `posevote experiment`, the short form of each.
#include <catch2/catch.hpp>

#include "tests/support/command.hpp"

using namespace posevote::test;
namespace fs = std::filesystem;

TEST_CASE("experiment sensitivity --quick: right under noise, and resumes", "[experiment]") {
  const TemporaryFolder folder;
  const std::string arguments =
      "experiment sensitivity --quick --methods posevote --out " + (folder / "out").string();
  const CommandResult first = run_posevote(folder, arguments);
  INFO(first.output);
  REQUIRE(first.status == 0);
  CHECK(first.output.find("right in 3 of 3") != std::string::npos);
  const std::string csv = read_text(folder / "out/sensitivity.csv");
  CHECK(csv.find("0.03,") != std::string::npos);
  const CommandResult second = run_posevote(folder, arguments);
  INFO(second.output);
  CHECK(second.status == 0);
  CHECK(second.output.find("answered already") != std::string::npos);
  CHECK(read_text(folder / "out/sensitivity.csv") == csv);
}

TEST_CASE("experiment refuses what it cannot do", "[experiment]") {
  const TemporaryFolder folder;
  CHECK(run_posevote(folder, "experiment cooking").status == 2);
  const CommandResult method = run_posevote(
      folder, "experiment sensitivity --methods magic --out " + (folder / "a").string());
  CHECK(method.status == 2);
  CHECK(method.output.find("magic") != std::string::npos);
  const CommandResult data = run_posevote(
      folder, "experiment sensitivity --dataset nowhere.ply --out " + (folder / "b").string());
  CHECK(data.status == 2);
  CHECK(data.output.find("nowhere.ply") != std::string::npos);
}
