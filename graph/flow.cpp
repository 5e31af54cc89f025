// SPDX-License-Identifier: BSD-3-Clause
#include "graph/flow.hpp"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>

#include "graph/node_call.hpp"

namespace posevote::graph {
namespace {

namespace flow = oneapi::tbb::flow;
using detail::UntypedFrame;
using detail::UntypedResult;
using NextFrame = std::function<std::optional<UntypedFrame>()>;
using OnResult = std::function<void(UntypedResult&&)>;

/// One frame in flight. A stream's value is written once, by its producer, before the producer
/// passes the frame on, and released by the last of its readers; arrivals count how many edges have
/// come in.
struct FrameState {
  FrameState(std::size_t order, UntypedFrame entering, const Plan& plan)
      : sequence(order),
        frame(std::move(entering)),
        values(plan.streams.size()),
        readers(plan.streams.size()),
        arrivals(plan.nodes.size() + 1),
        failures(plan.nodes.size()),
        spans(plan.nodes.size()) {
    for (std::size_t i = 0; i < plan.streams.size(); ++i)
      readers[i] = static_cast<int>(plan.streams[i].consumers.size());
  }

  std::size_t sequence;
  UntypedFrame frame;
  std::vector<Value> values;
  std::vector<std::atomic<int>> readers;
  std::vector<std::atomic<int>> arrivals;  ///< per node, the last one for the sink
  std::vector<std::optional<Failure>> failures;
  std::vector<Span> spans;
};

using Message = std::shared_ptr<FrameState>;
using Stage = flow::multifunction_node<Message, std::tuple<Message>>;

Value find_constant(const Stream& stream, const Constants& constants) {
  const auto found = constants.find(stream.name);
  if (found == constants.end())
    throw std::invalid_argument("the constant '" + stream.name + "' is not given");
  if (!(found->second.type == stream.type))
    throw std::invalid_argument("the constant '" + stream.name + "' is " + found->second.type.name +
                                ", expected " + stream.type.name);
  return found->second.value;
}

class Runner {
 public:
  Runner(const Plan& plan, const Constants& constants, const NextFrame& next_frame,
         const RunOptions& options, const OnResult& on_result)
      : plan_(plan),
        next_frame_(next_frame),
        options_(options),
        on_result_(on_result),
        constants_(plan.streams.size()),
        expected_(plan.nodes.size() + 1, 0),
        source_(graph_, [this](flow_control& control) { return next(control); }),
        limiter_(graph_, tokens()),
        gate_(graph_, flow::unlimited,
              [this](const Message& message, Stage::output_ports_type& out) {
                gather(message, out);
              }),
        order_(graph_, [](const Message& message) { return message->sequence; }),
        sink_(graph_, flow::serial, [this](const Message& message) { return leave(message); }) {
    for (std::size_t i = 0; i < plan.streams.size(); ++i)
      if (plan.streams[i].constant) constants_[i] = find_constant(plan.streams[i], constants);
    make_stages();
    make_edges();
  }

  ~Runner() { graph_.wait_for_all(); }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  RunSummary run() {
    source_.activate();
    graph_.wait_for_all();
    if (source_error_) std::rethrow_exception(source_error_);
    if (sink_error_) std::rethrow_exception(sink_error_);
    if (entered_ != left_)
      throw std::logic_error("frames were lost: " + std::to_string(entered_) + " entered, " +
                             std::to_string(left_) + " left");
    summary_.stopped = summary_.stopped || !source_ended_;
    return summary_;
  }

 private:
  using flow_control = oneapi::tbb::flow_control;

  std::size_t tokens() const {
    if (options_.tokens > 0) return options_.tokens;
    return 2 * static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
  }

  bool halted() const { return halt_ || (options_.interrupted && options_.interrupted->load()); }

  Message next(flow_control& control) {
    if (halted()) {
      control.stop();
      return nullptr;
    }
    try {
      std::optional<UntypedFrame> frame = next_frame_();
      if (!frame) {
        source_ended_ = true;
        control.stop();
        return nullptr;
      }
      auto message = std::make_shared<FrameState>(entered_, std::move(*frame), plan_);
      for (std::size_t i = 0; i < plan_.inputs.size(); ++i)
        message->values[std::size_t(plan_.inputs[i])] = message->frame.inputs.at(i);
      ++entered_;
      return message;
    } catch (...) {
      source_error_ = std::current_exception();
      control.stop();
      return nullptr;
    }
  }

  void make_stages() {
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      stages_.push_back(plan_.nodes[i].constant
                            ? nullptr
                            : std::make_unique<Stage>(
                                  graph_, flow::unlimited,
                                  [this, i](const Message& message, Stage::output_ports_type& out) {
                                    visit(i, message, out);
                                  }));
    }
  }

  /// One edge from each distinct producer (the limiter for what comes with the frame) to each node.
  /// A node whose output no other node reads, and one that only writes, lead to the gate.
  void make_edges() {
    std::vector<bool> leads_on(plan_.nodes.size(), false);
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      if (!stages_[i]) continue;
      std::vector<int> producers;
      for (const int input : plan_.nodes[i].inputs) {
        const Stream& stream = plan_.streams[std::size_t(input)];
        if (!stream.constant) producers.push_back(stream.producer);
      }
      std::sort(producers.begin(), producers.end());
      producers.erase(std::unique(producers.begin(), producers.end()), producers.end());
      expected_[i] = static_cast<int>(producers.size());
      for (const int producer : producers) {
        if (producer < 0) {
          flow::make_edge(limiter_, *stages_[i]);
        } else {
          flow::make_edge(flow::output_port<0>(*stages_[std::size_t(producer)]), *stages_[i]);
          leads_on[std::size_t(producer)] = true;
        }
      }
    }
    flow::make_edge(source_, limiter_);
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      if (!stages_[i] || leads_on[i]) continue;
      flow::make_edge(flow::output_port<0>(*stages_[i]), gate_);
      ++expected_.back();
    }
    if (expected_.back() == 0) {  // nothing but constants: frames pass straight through
      flow::make_edge(limiter_, gate_);
      expected_.back() = 1;
    }
    flow::make_edge(flow::output_port<0>(gate_), order_);
    flow::make_edge(order_, sink_);
    flow::make_edge(sink_, limiter_.decrementer());
  }

  /// True for the last of the edges that lead to a node (or to the gate).
  bool all_arrived(const Message& message, std::size_t at) const {
    return message->arrivals[at].fetch_add(1) + 1 == expected_[at];
  }

  void visit(std::size_t i, const Message& message, Stage::output_ports_type& out) {
    if (!all_arrived(message, i)) return;
    const PlannedNode& node = plan_.nodes[i];
    std::vector<Value> inputs;
    bool complete = true;
    for (const int input : node.inputs) {
      const std::size_t stream = std::size_t(input);
      inputs.push_back(plan_.streams[stream].constant ? constants_[stream]
                                                      : message->values[stream]);
      complete = complete && inputs.back();
    }
    if (complete) call(i, inputs, *message);
    inputs.clear();
    release_inputs(node, *message);
    std::get<0>(out).try_put(message);
  }

  void call(std::size_t i, const std::vector<Value>& inputs, FrameState& state) {
    const PlannedNode& node = plan_.nodes[i];
    Span& span = state.spans[i];
    span.thread = oneapi::tbb::this_task_arena::current_thread_index();
    span.begin = microseconds();
    try {
      Value value = call_node(node, inputs, state.frame.context);
      if (node.output >= 0) state.values[std::size_t(node.output)] = std::move(value);
    } catch (const ObjectError& error) {
      state.failures[i] = {node.name, error.what(), error.object, error.cause};
    } catch (const std::exception& error) {
      state.failures[i] = {node.name, reason_of(error)};
    } catch (...) {
      state.failures[i] = {node.name, "unknown exception"};
    }
    span.end = microseconds();
  }

  void release_inputs(const PlannedNode& node, FrameState& state) const {
    for (const int input : node.inputs) {
      const std::size_t stream = std::size_t(input);
      if (state.readers[stream].fetch_sub(1) == 1) state.values[stream].reset();
    }
  }

  void gather(const Message& message, Stage::output_ports_type& out) {
    if (all_arrived(message, plan_.nodes.size())) std::get<0>(out).try_put(message);
  }

  flow::continue_msg leave(const Message& message) {
    ++left_;
    if (summary_.stopped || sink_error_) return {};
    UntypedResult result;
    result.context = message->frame.context;
    const Stream& stream = plan_.streams[std::size_t(plan_.result)];
    result.result = stream.constant ? constants_[std::size_t(plan_.result)]
                                    : message->values[std::size_t(plan_.result)];
    result.spans = std::move(message->spans);
    for (const auto& failure : message->failures)
      if (failure && !result.failure) result.failure = failure;
    ++(result.failure ? summary_.failed : summary_.done);
    try {
      const bool failed = result.failure.has_value();
      on_result_(std::move(result));
      if (failed && options_.stop_on_failure) summary_.stopped = halt_ = true;
    } catch (...) {
      sink_error_ = std::current_exception();
      halt_ = true;
    }
    return {};
  }

  double microseconds() const {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start_)
        .count();
  }

  const Plan& plan_;
  const NextFrame& next_frame_;
  const RunOptions options_;
  const OnResult& on_result_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::vector<Value> constants_;
  std::vector<int> expected_;  ///< per node, the last one for the gate: edges that lead there
  std::size_t entered_ = 0;
  std::size_t left_ = 0;
  bool source_ended_ = false;
  std::atomic<bool> halt_ = false;
  std::exception_ptr source_error_;
  std::exception_ptr sink_error_;
  RunSummary summary_;

  flow::graph graph_;
  flow::input_node<Message> source_;
  flow::limiter_node<Message> limiter_;
  std::vector<std::unique_ptr<Stage>> stages_;
  Stage gate_;
  flow::sequencer_node<Message> order_;
  flow::function_node<Message, flow::continue_msg> sink_;
};

}  // namespace

Constants fold_constants(const Plan& plan, Constants constants) {
  for (const PlannedNode& node : plan.nodes) {
    if (!node.constant) continue;
    std::vector<Value> inputs;
    for (const int input : node.inputs)
      inputs.push_back(find_constant(plan.streams[std::size_t(input)], constants));
    try {
      Value value = call_node(node, inputs, FrameContext{});
      if (node.output < 0) continue;
      const Stream& stream = plan.streams[std::size_t(node.output)];
      constants[stream.name] = {stream.type, std::move(value)};
    } catch (const std::exception& error) {
      throw std::runtime_error(node.name + ": " + error.what());
    }
  }
  return constants;
}

RunSummary detail::run_flow(const Plan& plan, const Constants& constants, const NextFrame& source,
                            const RunOptions& options, const OnResult& on_result) {
  return Runner(plan, constants, source, options, on_result).run();
}

}  // namespace posevote::graph
