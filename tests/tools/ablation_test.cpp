// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ablation/ablation.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "graph/yaml_reader.hpp"
#include "pipelines/configuration.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/ablation/replay.hpp"
#include "tools/ablation/variations.hpp"

namespace posevote::ablation_test {

using namespace posevote::ablation;

namespace {

/// Nodes that count how often they run.
int doubled = 0, summed = 0;

struct Factor {
  double factor = 2;
};
double test_multiply(const double& number, const Factor& params) {
  ++doubled;
  return params.factor * number;
}
struct Nothing {};
double test_add(const double& a, const double& b, const Nothing&) {
  ++summed;
  return a + b;
}

const auto multiply =
    graph::register_node("test_multiply", test_multiply, "A multiple.")
        .input("number")
        .output("product")
        .param("factor", &Factor::factor, "", "How many times.", graph::in_range(0, 5));
const auto add =
    graph::register_node("test_add", test_add, "A sum.").input("a").input("b").output("sum");

/// sum = 2 x + 3 (2 x)
graph::Plan make_plan(const test::TemporaryFolder& folder) {
  std::vector<graph::Problem> problems;
  const graph::PipelineDescription description = graph::read_pipeline(
      folder.write("p.yaml",
                   "inputs: [x]\nresult: sum\nnodes:\n"
                   "  twice: {node: test_multiply, in: x, out: two}\n"
                   "  thrice: {node: test_multiply, in: two, out: six, factor: 3}\n"
                   "  test_add: {in: [two, six], out: sum}\n"),
      problems);
  graph::Plan plan = graph::make_plan(
      description, graph::Pipeline<double(double)>::ends("a pipeline for tests"), problems);
  REQUIRE(problems.empty());
  return plan;
}

graph::Value value_of(double number) { return std::make_shared<const double>(number); }
double number_in(const graph::Value& value) { return graph::StreamTraits<double>::unwrap(value); }

std::string changes_of(const graph::PlannedNode& node, const std::string& term) {
  std::string text;
  for (const Variation& one : vary(node, {term})) text += one.change + " " + one.value + " ";
  return text;
}

}  // namespace

TEST_CASE("a replay runs again what a changed node changes, and nothing else", "[ablation]") {
  const test::TemporaryFolder folder;
  const graph::Plan plan = make_plan(folder);
  doubled = summed = 0;
  const Replay replay(plan, {}, {value_of(1)});
  CHECK(doubled == 2);
  CHECK(summed == 1);
  CHECK(number_in(replay.value("six")) == 6);
  const std::vector<Variation> changes = vary(find_planned(plan, "thrice"), {});
  REQUIRE(changes.size() == 1);  // half of 3; twice is out of range
  CHECK(number_in(replay.rerun(changes[0].node)) == 5);
  CHECK(doubled == 3);
  CHECK(summed == 2);
  CHECK(number_in(replay.rerun(find_planned(plan, "test_add"), {{"two", value_of(10)}})) == 16);
  CHECK(doubled == 3);
  CHECK(number_in(replay.value("two")) == 2);
  CHECK_THROWS_WITH(replay.value("ten"), Catch::Contains("has no stream 'ten'"));
  CHECK_THROWS_WITH(find_planned(plan, "nobody"), Catch::Contains("has no node 'nobody'"));
}

TEST_CASE("parameters are switched off, halved and doubled, as far as that may be", "[ablation]") {
  const Configuration configuration = load_configuration("icbin", {});
  const graph::PlannedNode& node = find_planned(configuration.scenes, "segment_objects");
  CHECK(changes_of(node, "outline_weight") == "off 0 half 1.5 double 6 ");
  CHECK(changes_of(node, "segment_objects.outline_weight") == "off 0 half 1.5 double 6 ");
  CHECK(changes_of(node, "finalists") == "off 1 half 2 double 8 ");
  CHECK(changes_of(node, "refine") == "off false ");
  CHECK(changes_of(node, "view_trusted") == "off 0 half 0.45 ");  // 1.8 is out of range
  CHECK(changes_of(node, "min_confidence") == "off 0 half 0.25 double 1 ");
  CHECK(changes_of(node, "max_instances").empty());
  CHECK(changes_of(node, "find_outline.outline_weight").empty());
}

TEST_CASE("a variation differs in one parameter alone", "[ablation]") {
  const Configuration configuration = load_configuration("icbin", {});
  const graph::PlannedNode& node = find_planned(configuration.scenes, "segment_objects");
  for (const Variation& one : vary(node, {})) {
    INFO(one.term << " " << one.change);
    std::string different;
    for (const graph::ParamSpec& param : node.spec->params)
      if (param.get(one.node.params.get()) != param.get(node.params.get()))
        different += "segment_objects." + param.name;
    CHECK(different == one.term);
  }
}

TEST_CASE("whatever is said to be off is a parameter, and allowed", "[ablation]") {
  std::set<std::string> found;
  for (const char* name : {"segment_objects", "find_symmetries"}) {
    const graph::NodeSpec* spec = graph::find_node(name);
    REQUIRE(spec);
    const std::shared_ptr<void> params = spec->make_params();
    for (const graph::ParamSpec& param : spec->params) {
      const std::string off = off_value(param.name);
      if (off.empty()) continue;
      INFO(param.name << " = " << off);
      CHECK_FALSE(param.set(params.get(), off).has_value());
      found.insert(param.name);
    }
  }
  CHECK(found.size() == count_off_values());
}

TEST_CASE("the table says what each change does, beside what there is", "[ablation]") {
  const std::vector<TestSet> sets{{"uwa", "uwa", "", 1}, {"lmo", "bop", "", 1}};
  const std::vector<Row> rows{
      {"", "as it is", "", {{10, 8, 1, 2.0}, {20, 12, 0, 1.0}}},
      {"segment_objects.x", "off", "0", {{10, 6, 1, 1.0}, {20, 13, 4, 1.5}}}};
  const std::string table = to_markdown(sets, rows);
  INFO(table);
  CHECK(table.find("| all | as they are | | 8 of 10 | 1 | 2.00 s | 12 of 20 | 0 | 1.00 s |\n") !=
        std::string::npos);
  CHECK(table.find("| segment_objects.x | off | 0 | -2 | = | 0.50 | +1 | +4 | 1.50 |\n") !=
        std::string::npos);
  CHECK(to_csv(sets, rows).find("lmo,segment_objects.x,off,0,20,13,4,1.5000\n") !=
        std::string::npos);
}

}  // namespace posevote::ablation_test
