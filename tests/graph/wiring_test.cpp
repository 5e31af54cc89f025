// SPDX-License-Identifier: BSD-3-Clause
#include "graph/wiring.hpp"

#include <catch2/catch.hpp>

#include "tests/graph/number_nodes.hpp"

namespace posevote::wiring_test {

using namespace posevote::test;

TEST_CASE("a plan says how it is wired and what its parameters are", "[plan]") {
  const graph::Plan plan = plan_of(kHead +
                                   "  last: {node: add, in: [b, n], out: r}\n"
                                   "  first: {node: multiply, in: n, out: b, factor: 3}\n");
  CHECK(graph::wiring(plan) == std::map<std::string, std::string>{{"first", "multiply(n) -> b"},
                                                                  {"last", "add(b, n) -> r"}});
  const graph::PlannedNode* first = graph::find_type(plan, "multiply");
  REQUIRE(first);
  CHECK(first->name == "first");
  CHECK(graph::value_of(*first, "factor") == "3");
  CHECK_THROWS_WITH(graph::value_of(*first, "facto"), Catch::Contains("first has no parameter"));
  CHECK(graph::find_type(plan, "first") == nullptr);
  // An output that nobody wants has no stream.
  const graph::Plan halves = plan_of(kHead + "  halve: {in: n, out: {small: r}}\n");
  CHECK(graph::wiring(halves).at("halve") == "halve(n) -> r, -");
}

}  // namespace posevote::wiring_test
