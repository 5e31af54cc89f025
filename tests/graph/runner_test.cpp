// SPDX-License-Identifier: BSD-3-Clause
// Order, back-pressure, interrupts, lifting, states: whatever enters leaves.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>

#include "tests/graph/number_nodes.hpp"

namespace posevote::runner_test {

using namespace posevote::test;

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

TEST_CASE("expected bytes bound the frames in flight, but for one that is too large", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  wait_a_little: {in: n, out: r}\n");
  with_threads(8, [&] {
    for (const std::size_t bytes : {10, 40, 1000}) {
      peak_bodies = 0;
      std::size_t done = 0;
      graph::RunOptions options;
      options.tokens = 8;
      options.memory = 100;
      graph::run(plan, {},
                 graph::counted(60,
                                [bytes](std::size_t i) {
                                  const auto n = static_cast<int>(i);
                                  return graph::Frame<Number>{{i, "", {}, 0}, {Number{n}}, bytes};
                                }),
                 options, std::function([&](const NumberResult& result) {
                   CHECK(result.result->value == static_cast<int>(done++));
                 }));
      CHECK(done == 60);
      CHECK(peak_bodies <= static_cast<int>(std::clamp<std::size_t>(100 / bytes, 1, 8)));
      if (bytes == 10) CHECK(peak_bodies > 2);
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

TEST_CASE("a node that runs last is told how long ago the frame was there", "[runner]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  keep_log: {in: r}\n"
                                      "  multiply: {in: n, out: r}\n");
  for (const bool awaited : {false, true}) {
    const auto now = std::chrono::steady_clock::now();
    graph::Frame<Number> frame{{}, {Number{1}}};
    if (awaited) frame.since = now - std::chrono::seconds(5);
    const auto result = graph::run_one(plan, {}, frame);
    CHECK(result.since == frame.since);
    CHECK(logged_latency.has_value() == awaited);
    if (awaited) CHECK(*logged_latency == Approx(5).margin(4.9));
  }
}

TEST_CASE("no frames, and a second run of one plan", "[runner]") {
  const NumberPipeline plan = plan_of(kHead + "  multiply: {in: n, out: r}\n");
  CHECK(run_numbers(plan, 0, {}, [](const auto&) {}).done == 0);
  CHECK(run_numbers(plan, 50, {}, [](const auto&) {}).done == 50);
  CHECK(run_numbers(plan, 50, {}, [](const auto&) {}).done == 50);
}

}  // namespace posevote::runner_test
