// SPDX-License-Identifier: BSD-3-Clause
// What is thrown, by a node, the source or the receiver, and who hears of it.
#include <catch2/catch.hpp>

#include "tests/graph/number_nodes.hpp"

namespace posevote::failures_test {

using namespace posevote::test;

TEST_CASE("a failing frame leaves as a named failure and the others go on", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  fail_on: {in: n, out: a, bad: 3}\n"
                                      "  multiply: {in: a, out: r}\n"
                                      "  swallow: {in: r}\n");
  with_threads(4, [&] {
    swallowed = 0;
    std::vector<bool> failed;
    const auto summary = run_numbers(plan, 9, {}, [&](const auto& result) {
      failed.push_back(result.failure.has_value());
      if (!result.failure) return;
      CHECK(result.failure->node == "fail_on");
      CHECK(result.failure->what == "met 3");
      CHECK_FALSE(result.spans[1].ran());
    });
    CHECK(failed ==
          std::vector<bool>{false, false, false, true, false, false, false, false, false});
    CHECK(summary.done == 8);
    CHECK(summary.failed == 1);
    CHECK(swallowed == 8);
  });
}

TEST_CASE("what is thrown need not be an exception type", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  fail_on: {in: n, out: r, odd_throw: true}\n");
  const auto summary = run_numbers(plan, 3, {}, [](const auto& result) {
    REQUIRE(result.failure);
    CHECK(result.failure->what == "unknown exception");
  });
  CHECK(summary.failed == 3);
}

TEST_CASE("stop_on_failure reports nothing behind the failed frame, at any thread count",
          "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  fail_on: {in: n, out: r, bad: 5}\n");
  for (const int threads : {1, 4})
    with_threads(threads, [&] {
      graph::RunOptions options;
      options.stop_on_failure = true;
      std::size_t reported = 0;
      const auto summary = run_numbers(plan, 1000, options, [&](const auto&) { ++reported; });
      CHECK(reported == 6);
      CHECK(summary.stopped);
      CHECK(summary.done == 5);
      CHECK(summary.failed == 1);
    });
}

TEST_CASE("what the receiver throws ends the run and comes out", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  multiply: {in: n, out: r}\n");
  CHECK_THROWS_WITH(run_numbers(plan, 1000, {},
                                [](const auto& result) {
                                  if (result.context.number == 4)
                                    throw std::runtime_error("disk full");
                                }),
                    "disk full");
}

TEST_CASE("the first failing object names itself", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  split: {in: n, out: objects}\n"
                                      "  fail_on: {in: objects, out: kept, bad: 4}\n"
                                      "  sum: {in: kept, out: r}\n");
  std::vector<std::string> what;
  run_numbers(plan, 6, {}, [&](const auto& result) {
    if (result.failure) what.push_back(result.failure->what);
  });
  CHECK(what == std::vector<std::string>{"object 3: met 4", "object 2: met 4", "object 1: met 4"});
}

TEST_CASE("a failure knows its objects and the causes apart", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  split: {in: n, out: objects}\n"
                                      "  fail_on: {in: objects, out: kept, bad: 4}\n"
                                      "  sum: {in: kept, out: r}\n");
  run_numbers(plan, 6, {}, [&](const auto& result) {
    if (!result.failure) return;
    REQUIRE(result.failure->objects.size() == 1);
    CHECK(result.failure->objects[0].object == 4 - result.context.number);
    CHECK(result.failure->objects[0].cause == "met 4");
  });
}

TEST_CASE("what the source throws ends the run and comes out", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  multiply: {in: n, out: r}\n");
  int reported = 0;
  const auto source = [next = 0]() mutable -> std::optional<graph::Frame<Number>> {
    if (next == 3) throw std::runtime_error("the sensor is gone");
    return graph::Frame<Number>{{}, {Number{next++}}};
  };
  CHECK_THROWS_WITH(
      graph::run(plan, {}, source, {}, std::function([&](const NumberResult&) { ++reported; })),
      "the sensor is gone");
  CHECK(reported == 3);
}

TEST_CASE("a node may end the run where no frame could do better", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  wait_a_little: {in: n, out: r}\n"
                                      "  keep_log: {in: r, limit: 5}\n");
  with_threads(4, [&] {
    CHECK_THROWS_WITH(run_numbers(plan, 100000, {}, [](const auto&) {}), "the log is full");
    CHECK(logged.size() == 5);
  });
}

}  // namespace posevote::failures_test
