// SPDX-License-Identifier: BSD-3-Clause
#include <oneapi/tbb/global_control.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "graph/runner.hpp"
#include "graph/yaml_reader.hpp"
#include "nodes/data/detections.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::average_count_test {
namespace {

struct Nothing {};

/// As many detections as the frame's number says; a negative one fails. Early frames take longest.
Detections find_some(const int& count, const Nothing&) {
  std::this_thread::sleep_for(std::chrono::milliseconds(count > 2 ? 1 : 10));
  if (count < 0) throw std::runtime_error("broken");
  Detections found;
  found.items.resize(static_cast<std::size_t>(count));
  return found;
}

const auto registered = graph::register_node("find_some", find_some, "Detections for the test.")
                            .input("count")
                            .output("detections");

std::vector<double> averages(const std::vector<int>& counts) {
  const test::TemporaryFolder folder;
  std::vector<graph::Problem> problems;
  const auto pipeline = graph::make_pipeline<double(int)>(
      graph::read_pipeline(folder.write("p.yaml",
                                        "inputs: [count]\nresult: average\nnodes:\n"
                                        "  find_some: {in: count, out: detections}\n"
                                        "  average_count: {in: detections, out: average, "
                                        "frames: 2}\n"),
                           problems),
      "a pipeline for tests", {}, problems);
  REQUIRE(problems.empty());
  std::vector<double> got;
  const auto make_frame = [&](std::size_t i) { return graph::Frame<int>{{}, {counts[i]}}; };
  graph::run(pipeline, {}, graph::counted(counts.size(), make_frame), {},
             std::function([&](const graph::FrameResult<double>& result) {
               got.push_back(result.failure ? -1 : *result.result);
             }));
  return got;
}

}  // namespace

TEST_CASE("a node with a state sees all frames in order, failed ones, too", "[examples]") {
  for (const std::size_t threads : {1U, 4U}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads);
    CHECK(averages({2, 4, -1, 6, 8}) == std::vector<double>{2, 3, -1, 3, 7});
  }
}

}  // namespace posevote::average_count_test
