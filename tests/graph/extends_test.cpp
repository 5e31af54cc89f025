// SPDX-License-Identifier: BSD-3-Clause
// Pipelines that say only what differs from another one.
#include <catch2/catch.hpp>

#include "tests/graph/number_nodes.hpp"

namespace posevote::extends_test {

using namespace posevote::test;

namespace {

/// Some pipelines in one folder.
struct Folder {
  TemporaryFolder folder;

  Folder() {
    write("base",
          "inputs: [n]\nresult: r\nnodes:\n"
          "  wait_a_little: {in: n, out: a}\n"
          "  times: {node: multiply, in: a, out: b, factor: 3}\n"
          "  add: {in: {a: a, b: b}, out: r}\n"
          "  swallow: {in: r}\n");
  }
  void write(const std::string& name, const std::string& yaml) const {
    folder.write(name + ".yaml", yaml);
  }
  graph::PipelineDescription read(const std::string& name,
                                  std::vector<graph::Problem>& problems) const {
    return graph::read_pipeline(folder / (name + ".yaml"), problems);
  }
  /// "file:line:column: subject: text" of each problem of a pipeline called `name`.
  std::vector<std::string> problems_of(const std::string& name) const {
    std::vector<graph::Problem> problems;
    const graph::PipelineDescription pipeline = read(name, problems);
    if (problems.empty())
      graph::make_pipeline<Number(Number)>(pipeline, "a pipeline of the tests", {}, problems);
    std::vector<std::string> lines;
    for (graph::Problem& problem : problems) {
      problem.where.file = std::filesystem::path(problem.where.file).filename();
      lines.push_back(to_string(problem));
    }
    return lines;
  }
  void check_one(const std::string& yaml, const std::string& line) const {
    write("variant", yaml);
    CHECK(problems_of("variant") == std::vector<std::string>{line});
  }
  std::string flat(const std::string& name) const {
    std::vector<graph::Problem> problems;
    const std::string yaml = graph::to_yaml(read(name, problems));
    for (const graph::Problem& problem : problems) FAIL_CHECK(to_string(problem));
    return yaml;
  }
};

}  // namespace

TEST_CASE("a variant removes, replaces and inserts, and keeps the order of the rest", "[extends]") {
  const Folder f;
  f.write("variant",
          "extends: base\nresult: s\n"
          "remove: [swallow]\n"
          "replace:\n"
          "  times: {name: halve, in: a, out: {small: b}}\n"
          "  add: {in: [a, b], out: r}\n"
          "insert:\n"
          "  late: {node: multiply, in: r, out: s}\n"
          "  first: {before: wait_a_little, node: weigh, in: n, out: t, weights: [1, 5]}\n"
          "  second: {after: first, node: count_letters, in: t, out: u}\n"
          "  swallow: {in: u}\n");
  CHECK(f.problems_of("variant").empty());
  CHECK(f.flat("variant") ==
        "inputs: n\nresult: s\nnodes:\n"
        "  first: {node: weigh, in: n, out: t, weights: [1, 5]}\n"
        "  second: {node: count_letters, in: t, out: u}\n"
        "  wait_a_little: {in: n, out: a}\n"
        "  halve: {in: a, out: {small: b}}\n"
        "  add: {in: [a, b], out: r}\n"
        "  late: {node: multiply, in: r, out: s}\n"
        "  swallow: {in: u}\n");
  f.write("flat", f.flat("variant"));  // is a pipeline itself
  CHECK(f.problems_of("flat").empty());
  CHECK(f.flat("flat") == f.flat("variant"));
}

TEST_CASE("a variant of a variant", "[extends]") {
  const Folder f;
  f.write("one", "extends: base\nreplace: {times: {name: halve, in: a, out: b}}\n");
  f.write("two",
          "extends: one\nmodels: others\nreplace: {halve: {name: fail_on, in: a, out: b}}\n");
  CHECK(f.problems_of("two").empty());
  CHECK(f.flat("two").find("  fail_on: {in: a, out: b}\n") != std::string::npos);
  CHECK(f.flat("two").find("models: others\n") == 0);
  CHECK(f.flat("two").find("halve") == std::string::npos);
}

TEST_CASE("a node put into a stream is read by all that read the stream", "[extends]") {
  const Folder f;
  f.write("variant",
          "extends: base\n"
          "insert:\n"
          "  shift: {node: multiply, into: n, factor: 2}\n"  // comes with the frame
          "  other: {after: add, node: swallow, in: n}\n"    // written later: the stream itself
          "  twice: {node: add, into: b, in: [b, a], out: more}\n"  // what a node makes
          "  last: {node: multiply, into: r}\n"                     // the result
          "  first: {node: fail_on, into: r, out: checked}\n");
  CHECK(f.problems_of("variant").empty());
  CHECK(f.flat("variant") ==
        "inputs: n\nresult: last\nnodes:\n"
        "  shift: {node: multiply, in: n, out: shift, factor: 2}\n"
        "  wait_a_little: {in: shift, out: a}\n"
        "  times: {node: multiply, in: a, out: b, factor: 3}\n"
        "  twice: {node: add, in: [b, a], out: more}\n"
        "  add: {in: {a: a, b: more}, out: r}\n"
        "  first: {node: fail_on, in: r, out: checked}\n"
        "  last: {node: multiply, in: checked, out: last}\n"
        "  other: {node: swallow, in: n}\n"
        "  swallow: {in: last}\n");
  f.write("flat", f.flat("variant"));
  CHECK(f.flat("flat") == f.flat("variant"));
}

TEST_CASE("what is wrong with a node put into a stream", "[extends]") {
  const Folder f;
  const auto check = [&f](const std::string& entry, const std::string& line) {
    f.check_one("extends: base\ninsert:\n  x: " + entry + "\n", "variant.yaml:3:" + line);
  };
  check("{node: multiply, into: m}",
        "29: m: nothing in the pipeline that this one extends reads such a stream, did you mean "
        "'n'?");
  check("{node: multiply, into: nowhere}",
        "29: nowhere: nothing in the pipeline that this one extends reads such a stream");
  check("{node: multiply, into: b, in: a}", "29: x: is put into 'b' but does not read it");
  check("{node: halve, into: b, out: [c, d]}",
        "26: x: is put into 'b', expected one stream in `out`");
  check("{node: multiply, into: b, after: add}",
        "3: x: has more than one of `after`, `before` and `into`");
  check("{node: multiply, into: [b]}", "29: x.into: expected one plain value");
  // what comes of another type is said where it is read
  f.check_one("extends: base\ninsert:\n  x: {node: to_text, into: b}\n",
              "base.yaml:6:3: add.b: expected test::Number, but node x produces 'x' as test::Text");
}

TEST_CASE("what is wrong with a variant is said where it stands", "[extends]") {
  const Folder f;
  f.check_one("extends: bse\nremove: [add]\n",
              "variant.yaml:1:10: extends: no pipeline is called 'bse', expected bse.yaml beside "
              "this one");
  f.check_one("extends: base\nremove: [swalow]\n",
              "variant.yaml:2:10: swalow: no such node in the pipeline that this one extends, did "
              "you mean 'swallow'?");
  f.check_one("extends: base\nreplace:\n  tims: {node: multiply, in: a, out: b}\n",
              "variant.yaml:3:3: tims: no such node in the pipeline that this one extends, did you "
              "mean 'times'?");
  f.check_one("extends: base\ninsert:\n  x: {after: ad, node: swallow, in: b}\n",
              "variant.yaml:3:14: ad: no such node in the pipeline that this one extends, did you "
              "mean 'add'?");
  f.check_one("extends: base\ninsert:\n  add: {in: [a, b], out: c}\n",
              "variant.yaml:3:3: add: the pipeline has a node of that name, in " +
                  (f.folder / "base.yaml").string() + ":6:3; expected another, or `replace`");
  f.check_one("extends: base\nreplace:\n  times: {name: add, in: [a, n], out: b}\n",
              "variant.yaml:3:3: add: the pipeline has a node of that name, in " +
                  (f.folder / "base.yaml").string() + ":6:3; expected another, or `replace`");
  f.check_one("extends: base\ninsert:\n  x: {after: add, before: add, node: swallow, in: b}\n",
              "variant.yaml:3:3: x: has more than one of `after`, `before` and `into`");
  f.check_one(
      "extends: base\nnodes:\n  x: {node: swallow, in: b}\n",
      "variant.yaml:1:1: nodes: stand beside `extends`, expected replace, insert and remove");
  f.check_one("inputs: [n]\nresult: n\nremove: [x]\nnodes:\n  swallow: {in: n}\n",
              "variant.yaml:1:1: extends: missing, expected beside replace, insert and remove");
  f.check_one("extends: base\nreplace:\n  times: {node: multiply, in: a, out: b, factor: 101}\n",
              "variant.yaml:3:50: times.factor: '101' is not allowed, must be in [-100, 100]");
  // the consequence stands in the other file
  f.check_one(
      "extends: base\nremove: [wait_a_little, times]\n"
      "insert: {count: {node: weigh, in: n, out: a}, c: {node: count_letters, in: a, out: b}}\n",
      "base.yaml:6:3: add.a: expected test::Number, but node count produces 'a' as "
      "test::Text");
}

TEST_CASE("variants that go round in a circle, and a broken one in the chain", "[extends]") {
  const Folder f;
  f.write("a", "extends: b\nremove: [add]\n");
  f.write("b", "extends: a\nremove: [add]\n");
  CHECK(f.problems_of("a") ==
        std::vector<std::string>{"b.yaml:1:10: extends: goes round in a circle: a -> b -> a"});
  f.check_one("extends: variant\n",
              "variant.yaml:1:10: extends: goes round in a circle: variant -> variant");
  f.write("c", "extends: d\nremove: [add]\n");
  f.write("d", "inputs: [n\n");
  const auto problems = f.problems_of("c");
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].find("d.yaml:2:1: is not valid YAML") == 0);
}

}  // namespace posevote::extends_test
