// SPDX-License-Identifier: BSD-3-Clause
// Runs a plan over frames as a oneTBB flow graph, without knowing the types at its ends;
// graph/runner.hpp does.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/activity.hpp"
#include "graph/plan.hpp"
#include "graph/trace.hpp"

namespace posevote::graph {

struct RunOptions {
  std::size_t tokens = 0;        ///< frames in flight; 0: twice the threads
  bool stop_on_failure = false;  ///< nothing after the first failed frame is reported
  const std::atomic<bool>* interrupted = nullptr;  ///< no frame enters once it is true
  Activity* activity = nullptr;  ///< where the calls of nodes are told, and may be cancelled
  std::size_t memory = 0;        ///< [bytes] of all frames in flight, as expected; 0: any
};

struct RunSummary {
  std::size_t done = 0;    ///< frames that left with a result
  std::size_t failed = 0;  ///< frames that left with a failure
  bool stopped = false;    ///< by stop_on_failure or an interrupt, before the source ended
};

/// A stream of a run that is the same for every frame.
struct Constant {
  StreamType type;
  Value value;
};
using Constants = std::map<std::string, Constant>;  ///< by the stream's name

/// Runs the nodes that depend on constants alone. Returns the given constants and theirs. Throws
/// std::runtime_error "node: what" if one of them fails.
Constants fold_constants(const Plan& plan, Constants constants, Activity* activity = nullptr);

namespace detail {

/// One value for each of the plan's inputs, in the plan's order and of the plan's types.
struct UntypedFrame {
  FrameContext context;
  std::vector<Value> inputs;
  std::size_t bytes = 0;
  std::optional<std::chrono::steady_clock::time_point> since{};
};

struct UntypedResult {
  FrameContext context;
  Value result;
  std::optional<Failure> failure;
  std::vector<Span> spans;
  std::vector<Warning> warnings;
  Figures figures;
  std::optional<std::chrono::steady_clock::time_point> since{};
};

/// See run() in graph/runner.hpp. Throws std::invalid_argument for a constant that is missing or of
/// another type than the plan's.
RunSummary run_flow(const Plan& plan, const Constants& constants,
                    const std::function<std::optional<UntypedFrame>()>& source,
                    const RunOptions& options,
                    const std::function<void(UntypedResult&&)>& on_result);

}  // namespace detail
}  // namespace posevote::graph
