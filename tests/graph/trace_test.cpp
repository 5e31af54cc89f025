// SPDX-License-Identifier: BSD-3-Clause
#include "graph/trace.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.hpp"

namespace posevote::trace_test {

using namespace posevote::test;

TEST_CASE("the trace adds up and is JSON that a viewer opens", "[trace]") {
  const TemporaryFolder folder;
  graph::Trace trace({"load", "match"});
  trace.write_to(folder.path() / "trace.json");
  trace.add("a", {{0, 2e6, 1}, {2e6, 3e6, 0}});
  trace.add("b\xff", {{1e6, 2e6, 0}, {}});
  CHECK(trace.close().empty());
  CHECK(trace.times()[0].calls == 2);
  CHECK(trace.times()[0].total == Approx(3));
  CHECK(trace.times()[0].mean() == Approx(1.5));
  CHECK(trace.times()[0].max == Approx(2));
  CHECK(trace.times()[1].calls == 1);
  std::ifstream file(folder.path() / "trace.json");
  const auto json = nlohmann::json::parse(file);
  REQUIRE(json["traceEvents"].size() == 3);
  CHECK(json["traceEvents"][0]["dur"] == 2e6);
  CHECK(graph::time_table(trace.times()).find("75.0%") != std::string::npos);
}

}  // namespace posevote::trace_test
