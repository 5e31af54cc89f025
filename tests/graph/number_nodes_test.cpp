// SPDX-License-Identifier: BSD-3-Clause
#include "tests/graph/number_nodes.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "graph/parallel.hpp"

namespace posevote::test {

std::atomic<int> peak_bodies = 0;
std::atomic<int> swallowed = 0;

namespace {

struct None {};
struct Factor {
  int factor = 2;
  struct {
    int offset = 0;
  } terms;
};
struct Bad {
  int bad = -1;
  bool odd_throw = false;
};
struct Names {
  std::string style = "plain";
  double size = 1.5;
};

Number multiply(const Number& in, const Factor& params) {
  return {in.value * params.factor + params.terms.offset};
}
Number add(const Number& a, const Number& b, const None&) { return {a.value + b.value}; }
Number fail_on(const Number& in, const Bad& params) {
  if (in.value == params.bad) throw std::runtime_error("met " + std::to_string(in.value));
  if (params.odd_throw) throw 42;  // NOLINT: not an exception type on purpose
  return in;
}
Text to_text(const Number& in, const Names& params) {
  return {params.style + std::to_string(in.value)};
}
PerObject<Number> split(const Number& in, const None&) {
  PerObject<Number> objects;
  for (int i = 0; i < 3; ++i)
    objects.slots.push_back(std::make_shared<const Number>(Number{in.value + i}));
  return objects;
}
Number sum(const PerObject<Number>& in, const None&) {
  int total = 0;
  for (std::size_t i = 0; i < in.size(); ++i) total = 10 * total + in[i].value;
  return {total};
}
void swallow(const Number&, const None&) { ++swallowed; }

/// Early frames take longest, so that they would arrive last if nobody sorted them.
Number wait_a_little(const Number& in, const None&) {
  static std::atomic<int> now = 0;
  const int running = ++now;
  int seen = peak_bodies;
  while (running > seen && !peak_bodies.compare_exchange_weak(seen, running)) {
  }
  std::this_thread::sleep_for(std::chrono::microseconds(200 * (7 - in.value % 8)));
  --now;
  return in;
}

/// Counts how deep one thread is inside this body: a waiting inner loop must not start another one.
Number nested(const Number& in, const None&) {
  thread_local int depth = 0;
  if (++depth > 1) throw std::logic_error("a body was entered again while it waited");
  std::atomic<int> total = 0;
  graph::parallel_for(64, 1, [&](std::size_t) {
    std::this_thread::sleep_for(std::chrono::microseconds(20));
    ++total;
  });
  --depth;
  return {in.value + total};
}

const auto r1 =
    graph::register_node("multiply", multiply, "Times a factor.")
        .input("in")
        .output("out")
        .param("factor", &Factor::factor, "", "What to multiply by.", graph::in_range(-100, 100))
        .expert_param(
            "offset", [](Factor& params) -> int& { return params.terms.offset; }, "",
            "What to add afterwards.", graph::at_least(0));
const auto r2 = graph::register_node("add", add, "a + b").input("a").input("b").output("sum");
const auto r3 = graph::register_node("fail_on", fail_on, "Fails on one value.")
                    .input("in")
                    .output("out")
                    .param("bad", &Bad::bad, "", "The value.")
                    .param("odd_throw", &Bad::odd_throw, "", "Throw an int.");
const auto r4 = graph::register_node("to_text", to_text, "As text.")
                    .input("in")
                    .output("text")
                    .param("style", &Names::style, "", "How.", graph::one_of({"plain", "fancy"}))
                    .param("size", &Names::size, "m", "How large.", graph::greater_than(0));
const auto r5 =
    graph::register_node("split", split, "Three objects.").input("in").output("objects");
const auto r6 = graph::register_node("sum", sum, "Digits.").input("objects").output("sum");
const auto r7 = graph::register_node("swallow", swallow, "Only writes.").input("in");
const auto r8 =
    graph::register_node("wait_a_little", wait_a_little, "Waits.").input("in").output("out");
const auto r9 = graph::register_node("nested", nested, "A loop inside.").input("in").output("out");

}  // namespace

graph::Plan plan_of(const std::string& yaml, std::vector<graph::Problem>& problems,
                    const std::map<std::string, graph::StreamType>& constants) {
  const TemporaryFolder folder;
  graph::PipelineDescription pipeline =
      graph::read_pipeline(folder.write("test.yaml", yaml), problems);
  graph::resolve_likes(pipeline, nullptr, problems);
  for (graph::Problem& problem : problems) problem.where.file = "test.yaml";
  graph::Plan plan = graph::make_plan(pipeline, constants, problems);
  for (graph::Problem& problem : problems) problem.where.file = "test.yaml";
  return plan;
}

graph::Plan plan_of(const std::string& yaml,
                    const std::map<std::string, graph::StreamType>& constants) {
  std::vector<graph::Problem> problems;
  graph::Plan plan = plan_of(yaml, problems, constants);
  for (const graph::Problem& problem : problems) FAIL(to_string(problem));
  return plan;
}

graph::RunSummary run_numbers(const graph::Plan& plan, std::size_t count,
                              const graph::RunOptions& options,
                              const std::function<void(const graph::FrameResult&)>& on_result,
                              const std::map<std::string, graph::Value>& constants) {
  return graph::run(
      plan, constants, count,
      [](std::size_t i) {
        graph::Frame frame;
        frame.context.number = i;
        frame.inputs = {number(static_cast<int>(i))};
        return frame;
      },
      options, on_result);
}

}  // namespace posevote::test
