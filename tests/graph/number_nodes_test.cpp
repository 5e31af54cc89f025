// SPDX-License-Identifier: BSD-3-Clause
#include "tests/graph/number_nodes.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <optional>
#include <thread>
#include <tuple>

#include "graph/parallel.hpp"

namespace posevote::test {

std::atomic<int> peak_bodies = 0;
std::atomic<int> swallowed = 0;
std::vector<std::string> logged;
std::optional<double> logged_latency;

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

/// The smaller and the larger half.
std::tuple<Number, Text> halve(const Number& in, const None&) {
  return {Number{in.value / 2}, Text{std::to_string(in.value - in.value / 2)}};
}
Number count_letters(const Text& in, const None&) { return {static_cast<int>(in.value.size())}; }

struct Total {
  int sum = 0;
  int missing = 0;
  std::thread::id busy;
};
/// A thousand for each frame that is missing, and all values so far. Not to be entered twice.
Number add_up(Total& total, const Number& in, const None&) {
  if (total.busy != std::thread::id()) throw std::logic_error("entered twice");
  total.busy = std::this_thread::get_id();
  std::this_thread::sleep_for(std::chrono::microseconds(100));
  total.sum += in.value;
  total.busy = std::thread::id();
  return {total.sum + 1000 * total.missing};
}
void miss(Total& total, const graph::Failure&, const graph::FrameContext&, const None&) {
  ++total.missing;
}

struct Limit {
  int limit = 1000;
};
struct Log {
  explicit Log(const Limit& params) : limit(params.limit) { logged.clear(); }
  int limit;
};
void keep_log(Log& log, const Number& in, const graph::FrameContext& context, const Limit&) {
  if (static_cast<int>(logged.size()) >= log.limit) throw graph::EndOfRun("the log is full");
  std::string line = std::to_string(in.value) + " after";
  for (const graph::Stage& stage : context.stages)
    if (stage.span.ran()) line += " " + stage.node;
  logged.push_back(line);
  logged_latency.reset();
  for (const graph::Stage& stage : context.stages)
    if (stage.figures.contains("latency_s")) logged_latency = stage.figures.at("latency_s")[0];
}
void log_failure(Log&, const graph::Failure& failure, const graph::FrameContext&, const Limit&) {
  logged.push_back(failure.node + ": " + failure.what);
}

struct Weights {
  std::vector<int> weights{1, 2};
  std::vector<std::string> words;
  std::optional<double> least;
  std::optional<double> most;
};
Text weigh(const Number& in, const Weights& params) {
  int sum = 0;
  for (const int weight : params.weights) sum += weight * in.value;
  std::string text = std::to_string(sum);
  for (const std::string& word : params.words) text += " " + word;
  return {text + (params.least ? " at least" : "")};
}
std::string check_weights(const Weights& params) {
  if (params.least && params.most && *params.least > *params.most)
    return "`least` must not be above `most`";
  return "";
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

const auto r10 =
    graph::register_node("halve", halve, "Two halves.").input("in").output("small").output("large");
const auto r11 = graph::register_node("count_letters", count_letters, "Of a text.")
                     .input("text")
                     .output("count");
const auto r12 = graph::register_stateful_node<Total>("add_up", add_up, "Sum of all frames.")
                     .input("in")
                     .output("sum")
                     .on_failure(miss);
const auto r13 = graph::register_stateful_node<Log>("keep_log", keep_log, "What it sees.")
                     .input("in")
                     .last()
                     .on_failure(log_failure)
                     .param("limit", &Limit::limit, "frames", "Ends the run.");
const auto r14 = graph::register_node("weigh", weigh, "Weighs.")
                     .input("in")
                     .output("text")
                     .param("weights", &Weights::weights, "", "Factors.", graph::at_least(0))
                     .param("words", &Weights::words, "", "Added.", graph::one_of({"a", "b"}))
                     .param("least", &Weights::least, "m", "Not less.", graph::at_least(0))
                     .param("most", &Weights::most, "m", "Not more.", graph::at_least(0))
                     .check(check_weights);

}  // namespace

NumberPipeline plan_of(const std::string& yaml,
                       const std::map<std::string, graph::StreamType>& constants) {
  std::vector<graph::Problem> problems;
  NumberPipeline plan = plan_of<Number(Number)>(yaml, problems, constants);
  for (const graph::Problem& problem : problems) FAIL(to_string(problem));
  return plan;
}

graph::RunSummary run_numbers(const NumberPipeline& plan, std::size_t count,
                              const graph::RunOptions& options,
                              const std::function<void(const NumberResult&)>& on_result,
                              const graph::Constants& constants) {
  const auto make_frame = [](std::size_t i) {
    graph::Frame<Number> frame;
    frame.context.number = i;
    frame.inputs = {Number{static_cast<int>(i)}};
    return frame;
  };
  return graph::run(plan, constants, graph::counted(count, make_frame), options, on_result);
}

}  // namespace posevote::test
