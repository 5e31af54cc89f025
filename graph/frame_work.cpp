// SPDX-License-Identifier: BSD-3-Clause
#include "graph/frame_work.hpp"

#include <oneapi/tbb/task_arena.h>

#include <stdexcept>
#include <utility>

#include "graph/awaited.hpp"
#include "graph/node_call.hpp"

namespace posevote::graph {
namespace {

using detail::FrameState;
using detail::FrameWork;

Value find_constant(const Stream& stream, const Constants& constants) {
  const auto found = constants.find(stream.name);
  if (found == constants.end())
    throw std::invalid_argument("the constant '" + stream.name + "' is not given");
  if (!(found->second.type == stream.type))
    throw std::invalid_argument("the constant '" + stream.name + "' is " + found->second.type.name +
                                ", expected " + stream.type.name);
  return found->second.value;
}

/// The nodes that must be done with a frame before node i; in the plan's order.
std::vector<std::size_t> nodes_before(const Plan& plan, std::size_t i) {
  std::vector<bool> before(plan.nodes.size(), false);
  if (plan.nodes[i].spec->last)
    for (std::size_t other = 0; other < before.size(); ++other)
      before[other] = !plan.nodes[other].spec->last;
  const auto mark_producers = [&](std::size_t node) {
    for (const int input : awaited(plan.nodes[node]))
      if (const int producer = plan.streams[std::size_t(input)].producer; producer >= 0)
        before[std::size_t(producer)] = true;
  };
  mark_producers(i);
  for (std::size_t other = i; other-- > 0;)  // producers stand before their readers
    if (before[other]) mark_producers(other);
  std::vector<std::size_t> found;
  for (std::size_t other = 0; other < before.size(); ++other)
    if (before[other]) found.push_back(other);
  return found;
}

}  // namespace

FrameState::FrameState(std::size_t order, UntypedFrame entering, const Plan& plan)
    : sequence(order),
      frame(std::move(entering)),
      values(plan.streams.size()),
      previous(plan.streams.size()),
      readers(plan.streams.size()),
      arrivals(plan.nodes.size() + 1),
      failures(plan.nodes.size()),
      warnings(plan.nodes.size()),
      figures(plan.nodes.size()),
      spans(plan.nodes.size()) {
  for (std::size_t i = 0; i < plan.streams.size(); ++i)
    readers[i] = static_cast<int>(plan.streams[i].consumers.size());
  for (std::size_t i = 0; i < plan.inputs.size(); ++i)
    values[std::size_t(plan.inputs[i])] = frame.inputs.at(i);
  frame.inputs.clear();
}

FrameWork::FrameWork(const Plan& plan, const Constants& constants, const RunOptions& options)
    : plan_(plan),
      stop_on_failure_(options.stop_on_failure),
      activity_(options.activity),
      constants_(plan.streams.size()),
      states_(plan.nodes.size()),
      before_(plan.nodes.size()),
      closed_(plan.nodes.size(), false) {
  for (std::size_t i = 0; i < plan.streams.size(); ++i)
    if (plan.streams[i].constant) constants_[i] = find_constant(plan.streams[i], constants);
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const PlannedNode& node = plan.nodes[i];
    if (!in_order(node)) continue;
    before_[i] = nodes_before(plan, i);
    if (node.spec->make_state) states_[i] = node.spec->make_state(node.params.get());
  }
}

void FrameWork::visit(std::size_t i, FrameState& state) {
  work(i, state);
  for (const int input : awaited(plan_.nodes[i])) {
    const std::size_t stream = std::size_t(input);
    if (state.readers[stream].fetch_sub(1) == 1) state.values[stream].reset();
  }
}

void FrameWork::work(std::size_t i, FrameState& state) {
  if (closed_[i]) return;
  if (const Failure* failure = failed_before(i, state)) {
    closed_[i] = stop_on_failure_;
    return tell(i, *failure, state);
  }
  std::vector<Value> inputs;
  for (std::size_t port = 0; port < plan_.nodes[i].inputs.size(); ++port) {
    const std::size_t stream = std::size_t(plan_.nodes[i].inputs[port]);
    if (is_previous(plan_.nodes[i], port)) {
      inputs.push_back(state.previous[stream]);
      continue;
    }
    inputs.push_back(plan_.streams[stream].constant ? constants_[stream] : state.values[stream]);
    if (!inputs.back()) return;  // a node before this one has failed
  }
  call(i, inputs, state);
  if (state.failures[i] && in_order(plan_.nodes[i])) closed_[i] = stop_on_failure_;
}

const Failure* FrameWork::failed_before(std::size_t i, const FrameState& state) const {
  for (const std::size_t other : before_[i])
    if (state.failures[other]) return &*state.failures[other];
  return nullptr;
}

/// Runs `work`; what it throws becomes the node's failure.
template <class Work>
void FrameWork::attempt(std::size_t i, FrameState& state, const Work& work) {
  const std::string& name = plan_.nodes[i].name;
  try {
    work();
  } catch (const EndOfRun&) {
    if (in_order(plan_.nodes[i])) closed_[i] = true;  // others run on several threads
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const ObjectErrors& error) {
    state.failures[i] = {name, error.what(), error.objects};
  } catch (const std::exception& error) {
    state.failures[i] = {name, reason_of(error)};
  } catch (...) {
    state.failures[i] = {name, "unknown exception"};
  }
}

void FrameWork::call(std::size_t i, const std::vector<Value>& inputs, FrameState& state) {
  const PlannedNode& node = plan_.nodes[i];
  Span& span = state.spans[i];
  span.thread = oneapi::tbb::this_task_arena::current_thread_index();
  span.begin = microseconds();
  const double begin = clock_.begin();
  Activity::Call running(activity_, node.name, state.frame.context.name);
  attempt(i, state, [&] {
    std::vector<Value> values =
        call_node(node, inputs, context_of(i, state), states_[i].get(), &running);
    for (std::size_t out = 0; out < values.size(); ++out)
      if (node.outputs[out] >= 0)
        state.values[std::size_t(node.outputs[out])] = std::move(values[out]);
  });
  span.share = clock_.end(begin);
  span.end = microseconds();
}

void FrameWork::tell(std::size_t i, const Failure& failure, FrameState& state) {
  const PlannedNode& node = plan_.nodes[i];
  if (!node.spec->on_failure) return;
  attempt(i, state, [&] {
    node.spec->on_failure(states_[i].get(), failure, context_of(i, state), node.params.get());
  });
}

FrameContext FrameWork::context_of(std::size_t i, FrameState& state) const {
  FrameContext context = state.frame.context;
  context.on_warning = [&state, i](const std::string& what) {
    const std::lock_guard lock(state.telling);
    state.warnings[i].insert(what);  // sorted: threads tell in any order
  };
  context.on_figure = [&state, i](const std::string& what, std::vector<double> figure) {
    const std::lock_guard lock(state.telling);
    state.figures[i][what] = std::move(figure);
  };
  if (!plan_.nodes[i].spec->last) return context;
  for (std::size_t other = 0; other < plan_.nodes.size(); ++other)
    if (!plan_.nodes[other].spec->last)
      context.stages.push_back({plan_.nodes[other].name,
                                state.spans[other],
                                state.figures[other],
                                {state.warnings[other].begin(), state.warnings[other].end()}});
  if (state.frame.since && !context.stages.empty()) {  // figures are told by stages
    const std::chrono::duration<double> latency =
        std::chrono::steady_clock::now() - *state.frame.since;
    context.stages.front().figures["latency_s"] = {latency.count()};
  }
  return context;
}

detail::UntypedResult FrameWork::result(FrameState& state) const {
  UntypedResult result;
  result.context = state.frame.context;
  result.since = state.frame.since;
  const std::size_t stream = std::size_t(plan_.result);
  result.result = plan_.streams[stream].constant ? constants_[stream] : state.values[stream];
  result.spans = std::move(state.spans);
  for (const auto& failure : state.failures)
    if (failure && !result.failure) result.failure = failure;
  for (std::size_t i = 0; i < plan_.nodes.size(); ++i)
    for (const std::string& what : state.warnings[i])
      result.warnings.push_back({plan_.nodes[i].name, what});
  for (const Figures& figures : state.figures)
    result.figures.insert(figures.begin(), figures.end());
  return result;
}

double FrameWork::microseconds() const {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start_)
      .count();
}

Constants fold_constants(const Plan& plan, Constants constants, Activity* activity) {
  for (const PlannedNode& node : plan.nodes) {
    if (!node.constant) continue;
    std::vector<Value> inputs;
    for (const int input : node.inputs)
      inputs.push_back(find_constant(plan.streams[std::size_t(input)], constants));
    try {
      Activity::Call running(activity, node.name, "");
      std::vector<Value> values = call_node(node, inputs, FrameContext{}, nullptr, &running);
      for (std::size_t out = 0; out < values.size(); ++out) {
        if (node.outputs[out] < 0) continue;
        const Stream& stream = plan.streams[std::size_t(node.outputs[out])];
        constants[stream.name] = {stream.type, std::move(values[out])};
      }
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& error) {
      throw std::runtime_error(node.name + ": " + error.what());
    }
  }
  return constants;
}

}  // namespace posevote::graph
