// SPDX-License-Identifier: BSD-3-Clause
// A node may read what a stream held in the frame before, even one that is made of its own output.
#include "graph/previous.hpp"

#include <catch2/catch.hpp>

#include "tests/graph/number_nodes.hpp"

namespace posevote::previous_test {

using namespace posevote::test;

namespace {

struct None {};

/// Not to be entered before the frame before has left its value: it would not know it.
Number add_before(const Number& in, const graph::Previous<Number>& before, const None&) {
  return {in.value + (before.value ? before.value->value : 100)};
}

const auto registered = graph::register_node("add_before", add_before, "In, and the sum before.")
                            .input("in")
                            .input("before")
                            .output("sum");

const std::string kSum =
    kHead + "  wait_a_little: {in: n, out: a}\n  add_before: {in: [a, r], out: b}\n";

std::vector<int> results(const NumberPipeline& plan, std::size_t tokens) {
  std::vector<int> values;
  graph::RunOptions options;
  options.tokens = tokens;
  run_numbers(plan, 20, options, [&](const auto& result) {
    values.push_back(result.failure ? -1 : result.result->value);
  });
  return values;
}

}  // namespace

TEST_CASE("what the frame before left is read at any number of threads and tokens", "[previous]") {
  const NumberPipeline plan = plan_of(kSum + "  add: {in: [b, b], out: r}\n");
  for (const int threads : {1, 2, 8})
    for (const std::size_t tokens : {1, 2, 16})
      with_threads(threads, [&] {
        const std::vector<int> values = results(plan, tokens);
        CHECK(values.size() == 20);
        CHECK(values[0] == 200);
        CHECK(values[3] == 2 * (3 + values[2]));
        CHECK(values == results(plan, 1));
      });
}

TEST_CASE("frames wait for the one before only where they read it", "[previous]") {
  const NumberPipeline plan = plan_of(kSum + "  multiply: {in: b, out: r, factor: 1}\n");
  with_threads(4, [&] {
    peak_bodies = 0;
    for (int run = 0; run < 20 && peak_bodies < 2; ++run) results(plan, 8);  // on a busy machine
    CHECK(peak_bodies > 1);
  });
}

TEST_CASE("of a frame that failed the value before it stands", "[previous]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  fail_on: {in: n, out: a, bad: 2}\n"
                                      "  add_before: {in: [a, r], out: r}\n");
  for (const std::size_t tokens : {1, 8}) {
    const std::vector<int> values = results(plan, tokens);
    CHECK(values[1] == 101);
    CHECK(values[2] == -1);
    CHECK(values[3] == 104);
  }
}

TEST_CASE("a stream that only the next frame reads has a reader, and may come from behind",
          "[previous]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  add_before: {in: [n, twice], out: r}\n"
                                      "  multiply: {in: n, out: twice}\n");
  for (const std::size_t tokens : {1, 8}) {
    const std::vector<int> values = results(plan, tokens);
    for (int i = 1; i < 20; ++i) CHECK(values[std::size_t(i)] == i + 2 * (i - 1));
  }
}

TEST_CASE("what cannot be read of the frame before", "[previous]") {
  const auto problem_of = [](const std::string& nodes) {
    std::vector<graph::Problem> problems;
    plan_of<Number(Number)>(kHead + nodes, problems);
    REQUIRE(problems.size() == 1);
    return to_string(problems[0]);
  };
  CHECK_THAT(problem_of("  add_before: {in: [n, n], out: r}\n"),
             Catch::Contains("add_before.before: reads 'n' of the frame before, expected what a "
                             "node makes of each frame"));
  CHECK_THAT(problem_of("  to_text: {in: n, out: t}\n  add_before: {in: [n, t], out: r}\n"),
             Catch::Contains("add_before.before: expected previous test::Number, but node to_text "
                             "produces 't' as test::Text"));
}

}  // namespace posevote::previous_test
