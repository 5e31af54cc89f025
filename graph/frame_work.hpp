// SPDX-License-Identifier: BSD-3-Clause
// What the nodes of a plan do with a frame: everything of a run but the flow from node to node.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "graph/flow.hpp"
#include "graph/shared_clock.hpp"

namespace posevote::graph::detail {

/// One frame in flight. A stream's value is written once, by its producer, before the producer
/// passes the frame on, and released by the last of its readers; arrivals count how many edges have
/// come in.
struct FrameState {
  FrameState(std::size_t order, UntypedFrame entering, const Plan& plan);

  std::size_t sequence;
  UntypedFrame frame;
  std::vector<Value> values;    ///< per stream
  std::vector<Value> previous;  ///< per stream that is handed on: of the frame before, or null
  std::vector<std::atomic<int>> readers;
  std::vector<std::atomic<int>> arrivals;  ///< per node, the last one for the sink
  std::vector<std::optional<Failure>> failures;
  std::mutex telling;  ///< held by whoever adds one: a lifted node runs on several threads
  std::vector<std::set<std::string>> warnings;  ///< per node
  std::vector<Figures> figures;                 ///< per node
  std::vector<Span> spans;
};

/// True for nodes that see the frames one by one, in their order.
inline bool in_order(const PlannedNode& node) { return node.spec->make_state || node.spec->last; }

/// The constants and the nodes' states of one run.
class FrameWork {
 public:
  /// Throws std::invalid_argument for a constant that is missing or of another type.
  FrameWork(const Plan& plan, const Constants& constants, const RunOptions& options);

  /// Lets node i work on the frame, if nothing that it waits for has failed, and releases what it
  /// has read. A node that keeps a state must see the frames one by one, in their order. Throws
  /// EndOfRun and Cancelled alone.
  void visit(std::size_t i, FrameState& state);

  UntypedResult result(FrameState& state) const;

 private:
  /// The first failure, in the plan's order, of the nodes that node i waits for.
  const Failure* failed_before(std::size_t i, const FrameState& state) const;
  void work(std::size_t i, FrameState& state);
  void call(std::size_t i, const std::vector<Value>& inputs, FrameState& state);
  /// Tells the node of a frame that failed before it.
  void tell(std::size_t i, const Failure& failure, FrameState& state);
  template <class Work>
  void attempt(std::size_t i, FrameState& state, const Work& work);
  /// What node i sees of the frame: with the stages, if it runs last.
  FrameContext context_of(std::size_t i, FrameState& state) const;
  double microseconds() const;

  const Plan& plan_;
  const bool stop_on_failure_;
  Activity* const activity_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  SharedClock clock_;
  std::vector<Value> constants_;               ///< per stream
  std::vector<std::shared_ptr<void>> states_;  ///< per node; null where it keeps none
  std::vector<std::vector<std::size_t>>
      before_;                ///< per node with a state: those that it waits for
  std::vector<char> closed_;  ///< per node: with stop_on_failure, a frame has failed
};

}  // namespace posevote::graph::detail
