// SPDX-License-Identifier: BSD-3-Clause
// Order, back-pressure, failures, cancellation, lifting: whatever enters leaves.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/graph/number_nodes.hpp"

using namespace posevote;
using namespace posevote::test;

namespace {

const std::string kHead = "inputs: [n]\nresult: r\nnodes:\n";

/// Runs in an arena of that many threads, however many cores there are.
template <class Body>
void with_threads(int threads, const Body& body) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
  oneapi::tbb::task_arena(threads).execute(body);
}

}  // namespace

TEST_CASE("results leave in frame order, whatever takes longest", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  wait_a_little: {in: n, out: r}\n");
  for (const int threads : {1, 2, 8})
    with_threads(threads, [&] {
      std::vector<int> order;
      const auto summary = run_numbers(
          plan, 100, {}, [&](const auto& result) { order.push_back(result.result->value); });
      CHECK(summary.done == 100);
      REQUIRE(order.size() == 100);
      for (int i = 0; i < 100; ++i) REQUIRE(order[std::size_t(i)] == i);
    });
}

TEST_CASE("tokens bound the frames in flight", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  wait_a_little: {in: n, out: r}\n");
  with_threads(8, [&] {
    for (const std::size_t tokens : {1, 3}) {
      peak_bodies = 0;
      graph::RunOptions options;
      options.tokens = tokens;
      run_numbers(plan, 60, options, [](const auto&) {});
      CHECK(peak_bodies <= static_cast<int>(tokens));
    }
  });
}

TEST_CASE("a diamond joins what belongs to one frame", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  wait_a_little: {in: n, out: a}\n"
                                      "  multiply: {in: n, out: b, factor: 10}\n"
                                      "  add: {in: [a, b], out: r}\n");
  with_threads(4, [&] {
    int next = 0;
    run_numbers(plan, 64, {}, [&](const auto& result) {
      CHECK(result.result->value == 11 * next);
      ++next;
    });
    CHECK(next == 64);
  });
}

TEST_CASE("a node may read one stream twice", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  add: {in: [n, n], out: r}\n");
  int next = 0;
  run_numbers(plan, 5, {}, [&](const auto& result) { CHECK(result.result->value == 2 * next++); });
}

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

TEST_CASE("an interrupt lets the frames in flight leave", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  wait_a_little: {in: n, out: r}\n");
  with_threads(4, [&] {
    std::atomic<bool> interrupted = false;
    graph::RunOptions options;
    options.interrupted = &interrupted;
    options.tokens = 4;
    std::size_t reported = 0;
    const auto summary = run_numbers(plan, 100000, options, [&](const auto& result) {
      CHECK(result.context.number == reported);
      if (++reported == 10) interrupted = true;
    });
    CHECK(summary.stopped);
    CHECK(reported >= 10);
    CHECK(reported <= 20);
    CHECK(summary.done == reported);
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

TEST_CASE("a node written for one object runs over all of them, slots in order", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  split: {in: n, out: objects}\n"
                                      "  multiply: {in: objects, out: doubled}\n"
                                      "  add: {in: [doubled, n], out: added}\n"
                                      "  sum: {in: added, out: r}\n");
  int next = 0;
  run_numbers(plan, 3, {}, [&](const auto& result) {
    const int n = next++;
    const int expected = 100 * (2 * n + n) + 10 * (2 * (n + 1) + n) + 2 * (n + 2) + n;
    CHECK(result.result->value == expected);
  });
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

TEST_CASE("a body that waits in an inner loop is not entered again", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  nested: {in: n, out: r}\n");
  with_threads(8, [&] {
    const auto summary = run_numbers(plan, 100, {}, [](const auto& result) {
      if (result.failure) FAIL_CHECK(result.failure->what);
    });
    CHECK(summary.done == 100);
  });
}

TEST_CASE("constants are worked out once, before the first frame", "[runner]") {
  const graph::StreamType type = graph::StreamTraits<Number>::type();
  const NumberPipeline plan = plan_of(kHead +
                                          "  multiply: {in: c, out: d, factor: 10}\n"
                                          "  add: {in: [n, d], out: r}\n",
                                      {{"c", type}});
  const auto constants = graph::fold_constants(plan, {{"c", number(4)}});
  std::vector<int> values;
  run_numbers(
      plan, 2, {},
      [&](const auto& result) {
        values.push_back(result.result->value);
        CHECK_FALSE(result.spans[0].ran());
      },
      constants);
  CHECK(values == std::vector<int>{40, 41});
  const NumberPipeline bad = plan_of(kHead +
                                         "  fail_on: {in: c, out: d, bad: 4}\n"
                                         "  add: {in: [n, d], out: r}\n",
                                     {{"c", type}});
  CHECK_THROWS_WITH(graph::fold_constants(bad, {{"c", number(4)}}), "fail_on: met 4");
}

TEST_CASE("a constant that is missing or of another type is refused", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  add: {in: [n, c], out: r}\n",
                                      {{"c", graph::StreamTraits<Number>::type()}});
  const auto run_with = [&plan](const graph::Constants& constants) {
    run_numbers(
        plan, 1, {}, [](const auto&) {}, constants);
  };
  CHECK_THROWS_WITH(run_with({}), "the constant 'c' is not given");
  CHECK_THROWS_WITH(run_with({{"c", graph::constant(std::make_shared<const Text>(Text{"one"}))}}),
                    "the constant 'c' is test::Text, expected test::Number");
}

TEST_CASE("a source need not know how many frames there will be", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  wait_a_little: {in: n, out: r}\n");
  for (const int threads : {1, 4})
    with_threads(threads, [&] {
      int value = 1;
      const auto doubling = [&value]() -> std::optional<graph::Frame<Number>> {
        if (value > 1000) return std::nullopt;
        return graph::Frame<Number>{{}, {Number{std::exchange(value, 2 * value)}}};
      };
      value = 1;
      std::vector<int> seen;
      const auto summary = graph::run(
          plan, {}, doubling, {},
          std::function([&](const NumberResult& result) { seen.push_back(result.result->value); }));
      CHECK(seen == std::vector<int>{1, 2, 4, 8, 16, 32, 64, 128, 256, 512});
      CHECK(summary.done == 10);
      CHECK_FALSE(summary.stopped);
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

TEST_CASE("all objects of a frame may be a pipeline's result", "[runner]") {
  std::vector<graph::Problem> problems;
  const auto plan = plan_of<PerObject<Number>(Number)>(
      kHead + "  split: {in: n, out: objects}\n  multiply: {in: objects, out: r}\n", problems);
  REQUIRE(problems.empty());
  const auto result = graph::run_one(plan, {}, {{}, {Number{5}}});
  REQUIRE(result.result);
  REQUIRE(result.result->size() == 3);
  CHECK((*result.result)[2].value == 14);
}

TEST_CASE("several outputs travel apart, those of each object in its slot", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  halve: {in: n, out: [small, large]}\n"
                                      "  count_letters: {in: large, out: letters}\n"
                                      "  add: {in: [small, letters], out: r}\n");
  int next = 0;
  run_numbers(plan, 40, {}, [&](const auto& result) {
    CHECK(result.result->value == next / 2 + (next - next / 2 < 10 ? 1 : 2));
    ++next;
  });
  const NumberPipeline lifted =
      plan_of(kHead +
              "  split: {in: n, out: objects}\n"
              "  halve: {in: objects, out: {large: large, small: small}}\n"
              "  count_letters: {in: large, out: letters}\n"
              "  add: {in: [small, letters], out: sums}\n"
              "  sum: {in: sums, out: r}\n");
  const auto result = graph::run_one(lifted, {}, {{}, {Number{4}}});
  CHECK(result.result->value == 334);  // 4/2 + 1, 5/2 + 1, 6/2 + 1
}

TEST_CASE("a node with a state sees the frames in order, failed ones apart, anew in each run",
          "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  wait_a_little: {in: n, out: a}\n"
                                      "  fail_on: {in: a, out: b, bad: 3}\n"
                                      "  add_up: {in: b, out: s}\n"
                                      "  multiply: {in: s, out: r, factor: 1}\n");
  for (const int threads : {1, 2, 8})
    with_threads(threads, [&] {
      for (int run = 0; run < 2; ++run) {
        int sum = 0, next = 0;
        const auto summary = run_numbers(plan, 60, {}, [&](const NumberResult& result) {
          const int n = next++;
          REQUIRE(result.failure.has_value() == (n == 3));
          if (n == 3) return;
          sum += n;
          CHECK(result.result->value == sum + (n > 3 ? 1000 : 0));
        });
        CHECK(summary.done == 59);
        CHECK(summary.failed == 1);
      }
    });
}

TEST_CASE("a node that runs last knows all stages and every failure, in order", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  keep_log: {in: r}\n"
                                      "  wait_a_little: {in: n, out: a}\n"
                                      "  fail_on: {in: a, out: b, bad: 1}\n"
                                      "  swallow: {in: b}\n"
                                      "  multiply: {in: n, out: r, factor: 10}\n");
  const std::string after = " after wait_a_little fail_on swallow multiply";
  for (const int threads : {1, 8})
    with_threads(threads, [&] {
      for (const bool stop : {false, true}) {
        graph::RunOptions options;
        options.stop_on_failure = stop;
        const auto summary = run_numbers(plan, 30, options, [](const auto&) {});
        CHECK(summary.failed == 1);
        REQUIRE(logged.size() == (stop ? 2 : 30));
        CHECK(logged[0] == "0" + after);
        CHECK(logged[1] == "fail_on: met 1");
        if (!stop) CHECK(logged[29] == "290" + after);
      }
    });
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

TEST_CASE("no frames, and a second run of one plan", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  multiply: {in: n, out: r}\n");
  CHECK(run_numbers(plan, 0, {}, [](const auto&) {}).done == 0);
  CHECK(run_numbers(plan, 50, {}, [](const auto&) {}).done == 50);
  CHECK(run_numbers(plan, 50, {}, [](const auto&) {}).done == 50);
}

TEST_CASE("the trace adds up and is JSON that a viewer opens", "[trace]") {
  const TemporaryFolder folder;
  graph::Trace trace({"load", "match"});
  trace.write_to(folder.path() / "trace.json");
  trace.add("a", {{0, 2e6, 1}, {2e6, 3e6, 0}});
  trace.add("b\xff", {{1e6, 2e6, 0}, {}});
  CHECK(trace.close());
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
