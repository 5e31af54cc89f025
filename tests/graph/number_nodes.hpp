// SPDX-License-Identifier: BSD-3-Clause
// Small node types for testing the framework, and a way to write a pipeline into a temporary file.
#pragma once

#include <atomic>
#include <string>

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
/// Times `swallow` was called.
extern std::atomic<int> swallowed;

/// Reads and plans a pipeline; what is wrong lands in `problems`.
graph::Plan plan_of(const std::string& yaml, std::vector<graph::Problem>& problems,
                    const std::map<std::string, graph::StreamType>& constants = {});
/// The same for a pipeline that must be fine.
graph::Plan plan_of(const std::string& yaml,
                    const std::map<std::string, graph::StreamType>& constants = {});

/// Runs frames with the values 0 .. count-1.
graph::RunSummary run_numbers(const graph::Plan& plan, std::size_t count,
                              const graph::RunOptions& options,
                              const std::function<void(const graph::FrameResult&)>& on_result,
                              const std::map<std::string, graph::Value>& constants = {});

inline graph::Value number(int value) { return std::make_shared<const Number>(Number{value}); }
inline int value_of(const graph::Value& value) {
  return static_cast<const Number*>(value.get())->value;
}

}  // namespace posevote::test
