// SPDX-License-Identifier: BSD-3-Clause
// Small node types for testing the framework, and a way to write a pipeline into a temporary file.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "graph/plan.hpp"
#include "graph/runner.hpp"
#include "graph/yaml_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::test {

struct Number {
  int value = 0;
};
struct Text {
  std::string value;
};

/// Most bodies of `wait_a_little` that ever ran at one time since it was last set to 0.
extern std::atomic<int> peak_bodies;
/// What `keep_log` has seen: "VALUE after NODE NODE ..." or "NODE: WHAT".
extern std::vector<std::string> logged;
/// [s]: the figure of the frame that `keep_log` saw last.
extern std::optional<double> logged_latency;
/// Times `swallow` was called.
extern std::atomic<int> swallowed;

/// How a pipeline from `n` to `r` begins.
inline const std::string kHead = "inputs: [n]\nresult: r\nnodes:\n";

using NumberPipeline = graph::Pipeline<Number(Number)>;
using NumberResult = graph::FrameResult<Number>;

/// Reads a pipeline and plans it for the ends that Signature names; what is wrong lands in
/// `problems`.
template <class Signature = Number(Number)>
graph::Pipeline<Signature> plan_of(const std::string& yaml, std::vector<graph::Problem>& problems,
                                   const std::map<std::string, graph::StreamType>& constants = {}) {
  const TemporaryFolder folder;
  graph::PipelineDescription pipeline =
      graph::read_pipeline(folder.write("test.yaml", yaml), problems);
  graph::resolve_likes(pipeline, nullptr, problems);
  auto plan =
      graph::make_pipeline<Signature>(pipeline, "a pipeline of the tests", constants, problems);
  for (graph::Problem& problem : problems) problem.where.file = "test.yaml";
  return plan;
}
/// The same for a pipeline that must be fine.
NumberPipeline plan_of(const std::string& yaml,
                       const std::map<std::string, graph::StreamType>& constants = {});

/// Runs frames with the values 0 .. count-1.
graph::RunSummary run_numbers(const NumberPipeline& plan, std::size_t count,
                              const graph::RunOptions& options,
                              const std::function<void(const NumberResult&)>& on_result,
                              const graph::Constants& constants = {});

/// Runs in an arena of that many threads, however many cores there are.
template <class Body>
void with_threads(int threads, const Body& body) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
  oneapi::tbb::task_arena(threads).execute(body);
}

inline graph::Constant number(int value) {
  return graph::constant(std::make_shared<const Number>(Number{value}));
}

}  // namespace posevote::test
