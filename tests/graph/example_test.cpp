// SPDX-License-Identifier: BSD-3-Clause
// The example of graph/README.md, as it stands there.
#include <catch2/catch.hpp>

// [example
#include <cstdio>

#include "graph/runner.hpp"

using namespace posevote;

struct Celsius {
  double value = 0;
};
struct Alarm {
  bool on = false;
};

struct Params {
  double limit = 30;  // [deg C]
};
Alarm watch(const Celsius& in, const Params& params) { return {in.value > params.limit}; }

const auto registered = graph::register_node("watch", watch, "Is it too hot?")
                            .input("temperature")
                            .output("alarm")
                            .param("limit", &Params::limit, "deg C", "More is too hot.");

std::size_t count_alarms(const std::vector<double>& temperatures) {
  graph::PipelineDescription wiring;  // what graph::read_pipeline makes of a YAML file
  wiring.inputs = {{"", "temperature", {}}};
  wiring.result = {"", "alarm", {}};
  graph::NodeDescription node;
  node.name = node.type = "watch";
  node.inputs = wiring.inputs;
  node.outputs = {wiring.result};
  node.settings["limit"].text = "25";
  wiring.nodes.push_back(node);

  std::vector<graph::Problem> problems;
  const auto pipeline = graph::make_pipeline<Alarm(Celsius)>(wiring, "a thermostat", {}, problems);
  if (!problems.empty()) throw graph::ConfigError(problems);

  std::size_t alarms = 0;
  const auto make_frame = [&](std::size_t i) {
    return graph::Frame<Celsius>{{}, {Celsius{temperatures[i]}}};
  };
  graph::run(pipeline, {}, graph::counted(temperatures.size(), make_frame), {},
             std::function([&](const graph::FrameResult<Alarm>& result) {
               if (result.failure)
                 std::fprintf(stderr, "%s\n", result.failure->what.c_str());
               else if (result.result->on)
                 ++alarms;
             }));
  return alarms;
}
// example]

#include "tests/support/temporary_folder.hpp"

TEST_CASE("the example of graph/README.md runs, and stands there", "[docs]") {
  CHECK(count_alarms({20, 26, 24, 31}) == 2);
  const std::string source =
      test::read_text(std::filesystem::path(POSEVOTE_SOURCE_DIR) / "tests/graph/example_test.cpp");
  const std::size_t begin = source.find("// [example\n") + 12;
  const std::string code = source.substr(begin, source.find("// example]") - begin);
  const std::string readme =
      test::read_text(std::filesystem::path(POSEVOTE_SOURCE_DIR) / "graph/README.md");
  CHECK(readme.find("```cpp\n" + code + "```") != std::string::npos);
}
