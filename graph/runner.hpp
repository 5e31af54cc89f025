// SPDX-License-Identifier: BSD-3-Clause
// Runs a plan over frames as a oneTBB flow graph.
//
// A frame travels as one shared state. Each edge of the plan is an edge of the flow graph; a node
// runs when all the nodes that feed it have passed the frame on. Tokens bound the frames in flight.
// Every frame that enters leaves, in order, with its result or with the failure of the first node
// (in plan order) that failed; nodes behind a failed one are skipped.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/plan.hpp"
#include "graph/trace.hpp"

namespace posevote::graph {

struct Failure {
  std::string node;
  std::string what;
  /// Of a node that runs once for each object: which failed, from 0, and why, without its number.
  std::optional<std::size_t> object = std::nullopt;
  std::string cause{};
};

/// What enters: the context and one value for each of the plan's inputs, in the plan's order.
struct Frame {
  FrameContext context;
  std::vector<Value> inputs;
};

/// What leaves: either the result or a failure.
struct FrameResult {
  FrameContext context;
  Value result;
  std::optional<Failure> failure;
  std::vector<Span> spans;  ///< per node of the plan, in its order
};

struct RunOptions {
  std::size_t tokens = 0;        ///< frames in flight; 0: twice the threads
  bool stop_on_failure = false;  ///< nothing after the first failed frame is reported
  const std::atomic<bool>* interrupted = nullptr;  ///< no frame enters once it is true
};

struct RunSummary {
  std::size_t done = 0;    ///< frames that left with a result
  std::size_t failed = 0;  ///< frames that left with a failure
  bool stopped = false;    ///< by stop_on_failure or an interrupt, before all frames were reported
};

/// Runs the nodes that depend on constants alone. Returns the given constants and theirs, by the
/// name of the stream. Throws std::runtime_error "node: what" if one of them fails.
std::map<std::string, Value> fold_constants(const Plan& plan,
                                            std::map<std::string, Value> constants);

/// Runs frames 0 .. count-1 through the plan. `make_frame` is called in order, by one thread at a
/// time. `on_result` receives the results in order, one at a time; what it throws ends the run and
/// is rethrown. `constants`: a value for every constant stream, from fold_constants.
RunSummary run(const Plan& plan, const std::map<std::string, Value>& constants, std::size_t count,
               const std::function<Frame(std::size_t)>& make_frame, const RunOptions& options,
               const std::function<void(const FrameResult&)>& on_result);

/// Runs one frame on the calling thread's arena and returns its result.
FrameResult run_one(const Plan& plan, const std::map<std::string, Value>& constants, Frame frame);

}  // namespace posevote::graph
