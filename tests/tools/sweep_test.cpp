// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/sweep.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "graph/runner.hpp"
#include "graph/yaml_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::sweep_test {

using namespace posevote::sweep;

namespace {

int early_calls = 0, late_calls = 0, constant_calls = 0;

struct Factor {
  double factor = 2;
};
double sweep_early(const double& number, const Factor& params) {
  ++early_calls;
  if (number < 0) throw std::runtime_error("expected no debts");
  return params.factor * number;
}
double sweep_late(const double& number, const double& constant, const Factor& params) {
  ++late_calls;
  return params.factor * number + constant;
}
double sweep_constant(const double& number, const Factor& params) {
  ++constant_calls;
  return params.factor * number;
}
struct Sum {
  double sum = 0;
};
double sweep_count(Sum& state, const double& number, const Factor&) { return state.sum += number; }

const auto early = graph::register_node("sweep_early", sweep_early, "A multiple.")
                       .input("number")
                       .output("product")
                       .param("factor", &Factor::factor, "", "How many times.");
const auto late = graph::register_node("sweep_late", sweep_late, "A multiple and a number.")
                      .input("number")
                      .input("constant")
                      .output("sum")
                      .param("factor", &Factor::factor, "", "How many times.");
const auto constant = graph::register_node("sweep_constant", sweep_constant, "A multiple.")
                          .input("number")
                          .output("product")
                          .param("factor", &Factor::factor, "", "How many times.");
const auto stateful =
    graph::register_stateful_node<Sum>("sweep_count", sweep_count, "What there was so far.")
        .input("number")
        .output("sum")
        .param("factor", &Factor::factor, "", "Nothing.");

/// result = last_factor (first_factor x) + 10 c
graph::Plan make_plan(const test::TemporaryFolder& folder, double first_factor, double last_factor,
                      const std::string& first = "sweep_early") {
  std::vector<graph::Problem> problems;
  const auto description = graph::read_pipeline(
      folder.write("p.yaml",
                   "inputs: [x]\nmodels: m\nresult: sum\nnodes:\n  first: {node: " + first +
                       ", in: x, out: y, factor: " + std::to_string(first_factor) +
                       "}\n  sweep_constant: {in: c, out: k, factor: 10}\n"
                       "  sweep_late: {in: [y, k], out: sum, factor: " +
                       std::to_string(last_factor) + "}\n"),
      problems);
  graph::Plan plan =
      graph::make_plan(description,
                       graph::Pipeline<double(double)>::ends(
                           "a pipeline for tests", {{"c", graph::StreamTraits<double>::type()}}),
                       problems);
  for (const graph::Problem& problem : problems) UNSCOPED_INFO(graph::to_string(problem));
  REQUIRE(problems.empty());
  return plan;
}

graph::Value value_of(double number) { return std::make_shared<const double>(number); }
double number_in(const SharedStages::Outcome& outcome) {
  return graph::StreamTraits<double>::unwrap(outcome.result);
}

Counts counts(double correct, int instances, int detections) {
  Counts counts;
  counts.correct = correct, counts.instances = instances, counts.detections = detections;
  return counts;
}

}  // namespace

TEST_CASE("what settings have in common runs once", "[sweep]") {
  const test::TemporaryFolder folder;
  const std::vector<graph::Plan> plans{make_plan(folder, 2, 1), make_plan(folder, 2, 3),
                                       make_plan(folder, 5, 3), make_plan(folder, 2, 3)};
  const graph::Value c = value_of(1);
  std::vector<SharedStages::Variant> variants;
  for (const graph::Plan& plan : plans) variants.push_back({&plan, {{"c", c}}});
  early_calls = late_calls = constant_calls = 0;
  SharedStages stages(variants);
  CHECK(constant_calls == 1);
  CHECK(stages.answer_of(1) == stages.answer_of(3));
  CHECK(stages.answer_of(1) != stages.answer_of(2));
  const auto outcomes = stages.run({value_of(7)}, {});
  CHECK(number_in(outcomes[0]) == 24);
  CHECK(number_in(outcomes[1]) == 52);
  CHECK(number_in(outcomes[2]) == 115);
  CHECK(number_in(outcomes[3]) == 52);
  CHECK(early_calls == 2);
  CHECK(late_calls == 3);
  CHECK(number_in(stages.run({value_of(1)}, {})[2]) == 25);  // nothing of the frame before
  CHECK(early_calls == 4);
  const SharedStages::AllCalls calls = stages.take_calls();
  CHECK(calls.at("sweep_late").asked == 8);
  CHECK(calls.at("sweep_late").made == 6);
  CHECK(stages.take_calls().empty());
}

TEST_CASE("another constant is another answer", "[sweep]") {
  const test::TemporaryFolder folder;
  const graph::Plan plan = make_plan(folder, 2, 1);
  SharedStages stages({{&plan, {{"c", value_of(1)}}}, {&plan, {{"c", value_of(2)}}}});
  early_calls = 0;
  const auto outcomes = stages.run({value_of(1)}, {});
  CHECK(number_in(outcomes[0]) == 12);
  CHECK(number_in(outcomes[1]) == 22);
  CHECK(early_calls == 1);
}

TEST_CASE("a failure is that of all settings that share the node", "[sweep]") {
  const test::TemporaryFolder folder;
  const std::vector<graph::Plan> plans{make_plan(folder, 2, 1), make_plan(folder, 2, 3)};
  const graph::Value c = value_of(1);
  SharedStages stages({{&plans[0], {{"c", c}}}, {&plans[1], {{"c", c}}}});
  for (const auto& outcome : stages.run({value_of(-1)}, {})) {
    REQUIRE(outcome.failure);
    CHECK(*outcome.failure == "first: expected no debts");
    CHECK_FALSE(outcome.result);
  }
  CHECK_FALSE(stages.run({value_of(1)}, {})[1].failure);
}

TEST_CASE("what is carried from frame to frame cannot be shared", "[sweep]") {
  const test::TemporaryFolder folder;
  const graph::Plan plan = make_plan(folder, 2, 1, "sweep_count");
  CHECK_THROWS_WITH(SharedStages({{&plan, {{"c", value_of(1)}}}}),
                    Catch::Contains("first: carries something from frame to frame"));
}

TEST_CASE("--vary is read, and all combinations are made", "[sweep]") {
  const auto axes = read_axes({"a.b=1,2", "a.c=[1,2],[3]"});
  REQUIRE(axes.size() == 2);
  CHECK(axes[1].name() == "a.c");
  CHECK(axes[1].values == std::vector<std::string>{"[1,2]", "[3]"});
  const auto settings = combine(axes);
  REQUIRE(settings.size() == 4);
  CHECK(to_text(axes, settings[1]) == "a.b=1, a.c=[3]");
  CHECK(to_text(axes, settings[2]) == "a.b=2, a.c=[1,2]");
  const auto overrides = overrides_of(axes, settings[2]);
  CHECK(overrides[0].setting.where.file == "--vary a.b=2");
  for (const char* bad : {"abc", "a.b", "a.b=", "a.b=1,,2", "=1", ".b=1"}) {
    INFO(bad);
    CHECK_THROWS_WITH(read_axes({bad}), Catch::Contains("--vary " + std::string(bad)));
  }
  CHECK_THROWS_WITH(read_axes({"a.b=1", "a.b=2"}), Catch::Contains("varied twice"));
  std::string many = "=0";
  for (int i = 1; i < 40; ++i) many += "," + std::to_string(i);
  CHECK_THROWS_WITH(combine(read_axes({"a.b" + many, "a.c" + many})), Catch::Contains("1000"));
}

TEST_CASE("intervals hold what chance leaves open", "[sweep]") {
  // Of 40 images with one instance each, one setting finds 20, one the same and 10 more, one
  // nothing.
  std::vector<Counts> half, more, none;
  for (int i = 0; i < 40; ++i) {
    half.push_back(counts(i < 20, 1, 1));
    more.push_back(counts(i < 30, 1, 1));
    none.push_back(counts(0, 1, 0));
  }
  const auto result = bootstrap({half, more, none}, 1, &Counts::f1, 3);
  // The binomial's standard error is 0.0791 at a half: 1.96 of it to both sides.
  CHECK(result[0].recall.low == Approx(0.5 - 0.155).margin(0.026));
  CHECK(result[0].recall.high == Approx(0.5 + 0.155).margin(0.026));
  CHECK(result[1].behind.low == 0);
  CHECK(result[1].behind.high == 0);
  // Paired: the difference is a quarter of the images, with a standard error of 0.0685.
  CHECK(result[0].behind.low == Approx(0.25 - 0.134).margin(0.026));
  CHECK(result[0].behind.high == Approx(0.25 + 0.134).margin(0.026));
  CHECK(result[2].recall.high == 0);
  CHECK(result[2].behind.low > 0.5);
  const auto again = bootstrap({half, more, none}, 1, &Counts::f1, 3);
  CHECK(again[0].f1.low == result[0].f1.low);
  CHECK(total_of(more).recall() == 0.75);
}

TEST_CASE("one image has no interval", "[sweep]") {
  const auto result = bootstrap({{counts(1, 2, 1)}}, 0, &Counts::f1, 0);
  CHECK(std::isnan(result.at(0).f1.low));
  CHECK(std::isnan(result.at(0).behind.high));
}

TEST_CASE("the best setting is named, and those that may be as good", "[sweep]") {
  Sweep sweep;
  sweep.axes = read_axes({"a.b=1,2,4"});
  for (const Values& values : combine(sweep.axes)) sweep.settings.push_back({values, {}, 0, 1});
  sweep.images = 10;
  const Rule rule = choose_rules("add").at(0);
  sweep.rules = {{rule,
                  {counts(5, 10, 10), counts(8, 10, 10), counts(7, 10, 10)},
                  {{{.3, .7}, {.3, .7}, {.1, .5}},
                   {{.6, 1}, {.6, 1}, {0, 0}},
                   {{.5, .9}, {.5, .9}, {-.1, .2}}},
                  1}};
  const std::string text = to_text(sweep);
  INFO(text);
  CHECK(text.find("a.b=2; F1 0.800 [0.600, 1.000]\n") != std::string::npos);
  CHECK(text.find("worse: 0.100 to 0.500 below") != std::string::npos);
  CHECK(text.find("not told from it: -0.100 to 0.200 below") != std::string::npos);
  CHECK(text.find("others that cannot be told from it: 1\n") != std::string::npos);
  const auto json = to_json(sweep);
  CHECK(json["best"][0]["values"]["a.b"] == "2");
  CHECK(json["best"][0]["not_told_from_it"] == nlohmann::ordered_json{3});
  CHECK(json["rows"][0]["seconds_per_scan"] == 0.1);
  CHECK(to_svg(sweep).find("F1") != std::string::npos);
}

TEST_CASE("a rule by which nothing can be judged has no best setting", "[sweep]") {
  Sweep sweep;
  sweep.axes = read_axes({"a.b=1,2"});
  for (const Values& values : combine(sweep.axes)) sweep.settings.push_back({values, {}, 0, 1});
  sweep.images = 10;
  const std::vector<Certainty> certainty(2, {{0, 0}, {0, 0}, {0, 0}});
  sweep.rules = {{choose_rules("vsd18").at(0), {counts(0, 0, 4), counts(0, 0, 4)}, certainty, 0},
                 {choose_rules("add").at(0), {counts(5, 10, 10), counts(8, 10, 10)}, certainty, 1}};
  const std::string text = to_text(sweep);
  INFO(text);
  CHECK(text.find("no instance can be judged by it") != std::string::npos);
  CHECK(text.find("best by " + sweep.rules[0].rule.text) == std::string::npos);
  const auto json = to_json(sweep);
  CHECK(json["rows"][0]["recall"].is_null());
  CHECK(json["rows"][2]["recall"] == 0.5);
  REQUIRE(json["best"].size() == 1);
  CHECK(json["best"][0]["rule"] == "add");
  CHECK(to_svg(sweep).find(sweep.rules[1].rule.text) != std::string::npos);
}

}  // namespace posevote::sweep_test
