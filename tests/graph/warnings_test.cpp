// SPDX-License-Identifier: BSD-3-Clause
// What nodes tell of a frame that is answered nonetheless.
#include <catch2/catch.hpp>

#include "tests/graph/number_nodes.hpp"

namespace posevote::warnings_test {

using namespace posevote::test;

namespace {

struct None {};

Number doubt(const Number& in, const graph::FrameContext& context, const None&) {
  if (in.value % 3 == 0) context.warn(std::to_string(in.value) + " is odd of it");
  context.tell("value", {static_cast<double>(in.value)});
  return in;
}

std::vector<std::string> heard;

void listen(const Number&, const graph::FrameContext& context, const None&) {
  for (const graph::Stage& stage : context.stages)
    heard.push_back(stage.node + " " +
                    std::to_string(static_cast<int>(stage.figures.at("value").at(0))) +
                    (stage.warnings.empty() ? "" : " odd"));
}
const auto registered =
    graph::register_node("doubt", doubt, "Warns of some numbers.").input("n").output("n");
const auto registered_listen =
    graph::register_node("listen", listen, "Hears what others tell.").input("n").last();

}  // namespace

TEST_CASE("warnings come out with their frame, by the node's name", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  first: {node: doubt, in: n, out: a}\n"
                                      "  fail_on: {in: a, out: b, bad: 6}\n"
                                      "  second: {node: doubt, in: b, out: r}\n");
  with_threads(4, [&] {
    run_numbers(plan, 9, {}, [](const auto& result) {
      const int value = static_cast<int>(result.context.number);
      const std::size_t expected = value % 3 != 0 ? 0 : value == 6 ? 1 : 2;
      REQUIRE(result.warnings.size() == expected);
      if (expected == 0) return;
      CHECK(result.warnings[0].node == "first");
      CHECK(result.warnings[0].what == std::to_string(value) + " is odd of it");
      CHECK(result.warnings.back().node == (expected == 2 ? "second" : "first"));
    });
  });
}

TEST_CASE("objects that warn alike are heard once, others in one order", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  split: {in: n, out: objects}\n"
                                      "  doubt: {in: objects, out: same}\n"
                                      "  sum: {in: same, out: r}\n");
  run_numbers(plan, 4, {}, [](const auto& result) {
    REQUIRE(result.warnings.size() == 1);  // of three neighbours one
    CHECK(result.warnings[0].node == "doubt");
  });
}

TEST_CASE("without anybody to hear it what a node tells is nothing", "[runner]") {
  CHECK_NOTHROW(graph::FrameContext{}.warn("nobody"));
  CHECK_NOTHROW(graph::FrameContext{}.tell("count", {1}));
}

TEST_CASE("who runs last reads what the others told", "[runner]") {
  heard.clear();
  const NumberPipeline plan = plan_of(kHead +
                                      "  first: {node: doubt, in: n, out: a}\n"
                                      "  second: {node: doubt, in: a, out: r}\n"
                                      "  listen: {in: r}\n");
  run_numbers(plan, 4, {}, [](const auto&) {});
  CHECK(heard == std::vector<std::string>{"first 0 odd", "second 0 odd", "first 1", "second 1",
                                          "first 2", "second 2", "first 3 odd", "second 3 odd"});
}

}  // namespace posevote::warnings_test
