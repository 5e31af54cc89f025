// SPDX-License-Identifier: BSD-3-Clause
// Everything that can be wrong with a configuration is reported at once, with its place.
#include <algorithm>
#include <catch2/catch.hpp>

#include "graph/mermaid.hpp"
#include "tests/graph/number_nodes.hpp"

namespace posevote::plan_test {

using namespace posevote::test;

namespace {

/// The problems of a pipeline, one "file:line:column: subject: text" a line.
template <class Signature = Number(Number)>
std::vector<std::string> problems_of(const std::string& yaml) {
  std::vector<graph::Problem> problems;
  plan_of<Signature>(yaml, problems);
  std::vector<std::string> lines;
  for (const graph::Problem& problem : problems) lines.push_back(to_string(problem));
  return lines;
}

/// Exactly one problem, which begins with `begin` and contains `part`.
template <class Signature = Number(Number)>
void check_one(const std::string& yaml, const std::string& begin, const std::string& part) {
  const std::vector<std::string> lines = problems_of<Signature>(yaml);
  for (const std::string& line : lines) UNSCOPED_INFO(line);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].rfind(begin, 0) == 0);
  CHECK(lines[0].find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("a sound pipeline has no problems and runs in an order that feeds every node", "[plan]") {
  const graph::Plan plan = plan_of(kHead +
                                   "  last: {node: add, in: [b, n], out: r}\n"
                                   "  first: {node: multiply, in: n, out: b, factor: 3}\n");
  REQUIRE(plan.nodes.size() == 2);
  CHECK(plan.nodes[0].name == "first");
  CHECK(plan.nodes[1].name == "last");
}

TEST_CASE("one problem at a time", "[plan]") {
  check_one(kHead + "  multipy: {in: n, out: r}\n",
            "test.yaml:4:3: multipy: ", "unknown node 'multipy', did you mean 'multiply'?");
  check_one(kHead + "  multiply: {in: n, out: r, facto: 3}\n",
            "test.yaml:4:36: multiply.facto: ", "unknown parameter, did you mean 'factor'?");
  check_one(kHead + "  multiply: {in: n, out: r, factor: three}\n",
            "test.yaml:4:37: multiply.factor: ", "'three' is not allowed, expected int");
  check_one(kHead + "  multiply: {in: n, out: r, factor: 101}\n",
            "test.yaml:4:37: multiply.factor: ", "must be in [-100, 100]");
  check_one(kHead + "  multiply: {in: n, out: r, factor: 3, factor: 4}\n",
            "test.yaml:4:40: multiply.factor: ", "given twice, first in line 4");
  check_one(kHead + "  multiply: {in: m, out: r}\n  swallow: {in: n}\n",
            "test.yaml:4:18: multiply: ", "nobody produces the stream 'm'");
  check_one(kHead + "  add: {in: [n], out: r}\n", "test.yaml:4:3: add: ",
            "input 'b' is not connected, expected a stream of test::Number");
  check_one(kHead + "  add: {in: [n, n, n], out: r}\n",
            "test.yaml:4:20: add: ", "has 2 inputs, 'n' is one more");
  check_one(kHead + "  add: {in: {a: n, c: n}, out: r}\n  swallow: {in: n}\n",
            "test.yaml:4:23: add: ", "has no input 'c'");
  check_one(kHead + "  multiply: {in: n, out: r}\n  fail_on: {in: n, out: r}\n",
            "test.yaml:5:25: r: ", "produced twice, by node multiply and by node fail_on");
  check_one(kHead + "  to_text: {in: n, out: t}\n  multiply: {in: t, out: r}\n",
            "test.yaml:5:3: multiply.in: ",
            "expected test::Number, but node to_text produces 't' as test::Text");
  check_one(kHead + "  add: {in: [n, s], out: r}\n  multiply: {in: r, out: s}\n",
            "test.yaml:4:3: add: ", "a cycle through or before add, multiply");
  check_one(kHead + "  multiply: {in: n, out: r}\n  to_text: {in: n, out: t}\n",
            "test.yaml:5:3: t: ", "nobody reads this stream");
  check_one(kHead + "  multiply: {in: n, out: r}\n  swallow: {in: n, out: x}\n",
            "test.yaml:5:25: swallow: ", "only writes, expected no `out`");
  check_one(kHead +
                "  multiply: {in: n, out: r}\n  x: {like: multiply, in: n, out: y, factor: 2}\n"
                "  swallow: {in: y}\n",
            "test.yaml:5:46: x.factor: ", "cannot be set, expected multiply.factor");
  check_one(kHead + "  multiply: {in: n, out: r}\n  multiply: {in: n, out: y}\n",
            "test.yaml:5:3: multiply: ", "given twice, first in line 4");
  check_one("inputs: [n]\nresult: r\nnodes: {multiply: {in: n, out: r}}\nresults: x\n",
            "test.yaml:4:1: results: ", "unknown key, did you mean 'result'?");
  check_one(kHead + "  multiply: {in: n, out: r}\n bad indent: [\n",
            "test.yaml:5:", "not valid YAML");
}

TEST_CASE("the types of both ends are checked where they are named", "[plan]") {
  check_one(kHead + "  to_text: {in: n, out: r}\n", "test.yaml:2:9: result: ",
            "'r' is test::Text, expected test::Number, which a pipeline of the tests gives");
  check_one<Number(Text)>(kHead + "  multiply: {in: n, out: r}\n", "test.yaml:1:10: n: ",
                          "comes as test::Text with each frame of a pipeline of the tests, but "
                          "multiply.in expects test::Number");
  check_one("inputs: [n, m]\nresult: r\nnodes:\n  add: {in: [n, m], out: r}\n",
            "test.yaml:1:9: inputs: ",
            "2 streams, but each frame of a pipeline of the tests brings 1: test::Number");
  check_one<PerObject<Number>(Number)>(
      kHead + "  multiply: {in: n, out: r}\n",
      "test.yaml:2:9: result: ", "expected PerObject<test::Number>");
  CHECK(problems_of<Text(Number)>(kHead + "  to_text: {in: n, out: r}\n").empty());
}

TEST_CASE("a constant of another type is reported at the node that reads it", "[plan]") {
  std::vector<graph::Problem> problems;
  plan_of<Number(Number)>(kHead + "  add: {in: [n, c], out: r}\n", problems,
                          {{"c", graph::StreamTraits<Text>::type()}});
  REQUIRE(problems.size() == 1);
  CHECK(to_string(problems[0]) ==
        "test.yaml:4:3: add.b: expected test::Number, but the run produces 'c' as test::Text");
}

TEST_CASE("eight mistakes give eight located messages", "[plan]") {
  const std::vector<std::string> lines = problems_of(
      kHead +
      "  multiply: {in: n, out: a, factor: 1e9, fctor: 2}\n"                  // wrong type, unknown
      "  unknown_thing: {in: n, out: b}\n"                                    // unknown node
      "  to_text: {in: nn, out: t, size: -1, style: fancie, style: plain}\n"  // stream, range,
                                                                              // choice, twice
      "  add: {in: [a], out: r}\n");                                          // unconnected
  for (const std::string& line : lines) UNSCOPED_INFO(line);
  // the outputs b and t, which nobody reads, are two more
  CHECK(lines.size() == 10);
  CHECK(std::all_of(lines.begin(), lines.end(),
                    [](const std::string& line) { return line.rfind("test.yaml:", 0) == 0; }));
}

TEST_CASE("an override for a node that is not there is handed back", "[plan]") {
  graph::PipelineDescription pipeline;
  pipeline.nodes = {{"multiply", "multiply", "", {}, {}, {}, {}}};
  const auto left = graph::apply_overrides(
      pipeline, {{"multiply", "factor", {"5", {}}}, {"other", "x", {"1", {}}}});
  REQUIRE(left.size() == 1);
  CHECK(left[0].node == "other");
  CHECK(pipeline.nodes[0].settings.at("factor").text == "5");
}

TEST_CASE("--set is split at the first dot and the first equals sign", "[plan]") {
  std::vector<graph::Problem> problems;
  const graph::Override change = graph::read_set("to_text.style=a.b=c", problems);
  CHECK(change.node == "to_text");
  CHECK(change.key == "style");
  CHECK(change.setting.text == "a.b=c");
  CHECK(problems.empty());
  for (const char* wrong : {"x", "x=1", ".k=1", "x.=1", "=", ""}) graph::read_set(wrong, problems);
  CHECK(problems.size() == 6);
}

TEST_CASE("numbers are read the same everywhere, and only numbers", "[schema]") {
  CHECK(graph::Scalar<double>::parse("1e-3") == 0.001);
  CHECK(graph::Scalar<double>::parse("0.5") == 0.5);
  CHECK(graph::Scalar<int>::parse("-7") == -7);
  for (const char* wrong : {"010", "0x10", "1.5", "", " 1", "1 ", "yes", "99999999999"})
    CHECK_FALSE(graph::Scalar<int>::parse(wrong));
  for (const char* wrong : {"1,5", "", "00.5", "one"})
    CHECK_FALSE(graph::Scalar<double>::parse(wrong));
  for (const char* wrong : {"yes", "1", "True"}) CHECK_FALSE(graph::Scalar<bool>::parse(wrong));
  CHECK(graph::greater_than(0).violated_by(0));
  CHECK_FALSE(graph::at_least(0).violated_by(0));
  CHECK(graph::anything().violated_by(std::numeric_limits<double>::quiet_NaN()));
}

TEST_CASE("the wiring as DOT names every node and stream", "[plan]") {
  const graph::Plan plan = plan_of(kHead + "  double: {node: multiply, in: n, out: r}\n");
  const std::string dot = graph::to_dot({&plan});
  for (const char* part : {"\"n\" -> \"test/double\" [label=\"n\", tooltip=\"n: ",
                           "\"test/double\" -> \"r\"", "(multiply)", "rankdir=TB"})
    CHECK(dot.find(part) != std::string::npos);
}

TEST_CASE("the wiring as Mermaid has every node once and every stream between its ends", "[plan]") {
  const graph::Plan plan = plan_of(kHead + "  double: {node: multiply, in: n, out: r}\n");
  CHECK(graph::to_mermaid({&plan}) ==
        "flowchart TD\n  subgraph test\n    test.double[double]\n  end\n"
        "  stream.n([n])\n  stream.r([r])\n  stream.n -->|n| test.double\n"
        "  test.double -->|r| stream.r\n");
}

TEST_CASE("a parameter may lie deeper in its Params, and be marked for experts", "[schema]") {
  const graph::Plan plan = plan_of(kHead + "  multiply: {in: n, out: r, offset: 7}\n");
  CHECK(graph::effective_parameters(plan)["multiply"] ==
        std::map<std::string, std::string>{{"factor", "2"}, {"offset", "7"}});
  const std::vector<graph::ParamSpec>& params = plan.nodes[0].spec->params;
  CHECK_FALSE(params[0].expert);
  CHECK(params[1].expert);
  check_one(kHead + "  multiply: {in: n, out: r, offset: -1}\n",
            "test.yaml:4:37: multiply.offset: ", "must be >= 0");
}

TEST_CASE("lists and what may be unset", "[schema]") {
  const std::string head = "inputs: [n]\nresult: r\nnodes:\n  count_letters: {in: t, out: r}\n";
  const auto set = [](const std::string& values) {
    return graph::effective_parameters(
        plan_of("inputs: [n]\nresult: r\nnodes:\n  weigh: {in: n, out: t" + values +
                "}\n  count_letters: {in: t, out: r}\n"))["weigh"];
  };
  using Values = std::map<std::string, std::string>;
  CHECK(set("") ==
        Values{{"weights", "[1, 2]"}, {"words", "[]"}, {"least", "none"}, {"most", "none"}});
  CHECK(set(", weights: [3,  4 ,5], words: [a, b], least: 0.5, most: none") ==
        Values{{"weights", "[3, 4, 5]"}, {"words", "[a, b]"}, {"least", "0.5"}, {"most", "none"}});
  CHECK(set(", weights: '[7]', words: []")["weights"] == "[7]");  // as --set gives it
  const std::string wrong = head + "  weigh: {in: n, out: t, ";
  check_one(wrong + "weights: 3}\n",
            "test.yaml:5:35: weigh.weights: ", "'3' is not allowed, expected list of ints");
  check_one(wrong + "weights: [1, x]}\n",
            "test.yaml:5:35: weigh.weights: ", "expected list of ints");
  check_one(wrong + "weights: [1, -1]}\n", "test.yaml:5:35: weigh.weights: ", "must be >= 0");
  check_one(wrong + "words: [a, c]}\n", "test.yaml:5:33: weigh.words: ", "must be one of a, b");
  check_one(wrong + "words: ['a,b']}\n", "test.yaml:5:34: weigh.words: ", "holds no comma");
  check_one(wrong + "least: [1]}\n", "test.yaml:5:33: weigh.least: ", "expected number or none");
  check_one(wrong + "least: -1}\n", "test.yaml:5:33: weigh.least: ", "must be >= 0");
  for (const char* text : {"1, 2", "[1, 2", "[1,,2]", "[1,]"})
    CHECK_FALSE(graph::Scalar<std::vector<int>>::parse(text));
}

TEST_CASE("a broken rule between parameters is laid to the value that broke it", "[plan]") {
  const auto blamed = [](const std::string& in_pipeline, const std::vector<graph::Override>& sets) {
    const TemporaryFolder folder;
    std::vector<graph::Problem> problems;
    graph::PipelineDescription pipeline = graph::read_pipeline(
        folder.write("p.yaml", "inputs: [n]\nresult: t\nnodes:\n  weigh: {in: n, out: t" +
                                   in_pipeline + "}\n"),
        problems);
    graph::apply_overrides(pipeline, sets);
    graph::make_pipeline<Text(Number)>(pipeline, "a test", {}, problems);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].text == "`least` must not be above `most`");
    problems[0].where.file = std::filesystem::path(problems[0].where.file).filename();
    return to_string(problems[0].where);
  };
  std::vector<graph::Problem> none;
  const auto least = graph::read_set("weigh.least=5", none);
  const auto most = graph::read_set("weigh.most=1", none);
  CHECK(blamed(", least: 5, most: 1", {}) == "p.yaml:4:42");
  CHECK(blamed(", least: 1, most: 3", {least}) == "--set weigh.least=5");
  CHECK(blamed("", {least, most}) == "--set weigh.most=1");
  CHECK(blamed("", {most, least}) == "--set weigh.least=5");
  CHECK(blamed(", least: 3, most: 2", {most}) == "--set weigh.most=1");
}

TEST_CASE("a node may have several outputs, by name or in order", "[plan]") {
  const std::string tail = "  count_letters: {in: t, out: l}\n  add: {in: [s, l], out: r}\n";
  for (const std::string out : {"[s, t]", "{large: t, small: s}"})
    CHECK(problems_of(kHead + "  halve: {in: n, out: " + out + "}\n" + tail).empty());
  CHECK(
      problems_of(kHead + "  halve: {in: n, out: {small: r}}\n").empty());  // nobody wants `large`
  check_one(kHead +
                "  halve: {in: n, out: [r, t, u]}\n  count_letters: {in: t, out: l}\n"
                "  add: {in: [u, l], out: v}\n  swallow: {in: v}\n",
            "test.yaml:4:30: halve: ", "has 2 outputs, 'u' is one more");
  check_one(kHead +
                "  halve: {in: n, out: {small: r, larg: t}}\n  count_letters: {in: t, out: l}\n"
                "  swallow: {in: l}\n",
            "test.yaml:4:40: halve: ", "has no output 'larg', did you mean 'large'?");
  check_one(kHead + "  halve: {in: n}\n  multiply: {in: n, out: r}\n",
            "test.yaml:4:3: halve: ", "expected `out`: a name for its test::Number, test::Text");
}

TEST_CASE("a node with a state takes the objects of a frame all at once", "[plan]") {
  check_one(kHead + "  split: {in: n, out: o}\n  add_up: {in: o, out: s}\n  sum: {in: s, out: r}\n",
            "test.yaml:5:3: add_up: ", "would run for each object");
}

}  // namespace posevote::plan_test
