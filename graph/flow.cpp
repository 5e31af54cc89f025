// SPDX-License-Identifier: BSD-3-Clause
#include "graph/flow.hpp"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "graph/admission.hpp"
#include "graph/awaited.hpp"
#include "graph/frame_work.hpp"
#include "graph/handover.hpp"

namespace posevote::graph {
namespace {

namespace flow = oneapi::tbb::flow;
using detail::Admission;
using detail::FrameState;
using detail::FrameWork;
using detail::UntypedFrame;
using detail::UntypedResult;
using NextFrame = std::function<std::optional<UntypedFrame>()>;
using OnResult = std::function<void(UntypedResult&&)>;

using Message = std::shared_ptr<FrameState>;
using Stage = flow::multifunction_node<Message, std::tuple<Message>>;
using Outlet = Stage::output_ports_type;

/// A node of the plan. `entry` waits for all edges that lead here, and for what the frame before
/// hands on. A node that sees the frames in
/// order has them sorted and works on one at a time, in `serial`; any other works in `entry`.
struct Station {
  std::unique_ptr<Stage> entry;
  std::unique_ptr<flow::sequencer_node<Message>> sorter;
  std::unique_ptr<Stage> serial;

  auto& exit() { return flow::output_port<0>(serial ? *serial : *entry); }
};

class Runner {
 public:
  Runner(const Plan& plan, const Constants& constants, const NextFrame& next_frame,
         const RunOptions& options, const OnResult& on_result)
      : plan_(plan),
        next_frame_(next_frame),
        options_(options),
        on_result_(on_result),
        work_(plan, constants, options),
        expected_(plan.nodes.size() + 1, 0),
        admission_(tokens(), options.memory),
        handovers_(plan),
        entrance_(graph_),
        gate_(graph_, flow::unlimited,
              [this](const Message& message, Outlet& out) {
                if (all_arrived(message, plan_.nodes.size())) std::get<0>(out).try_put(message);
              }),
        order_(graph_, [](const Message& message) { return message->sequence; }),
        sink_(graph_, flow::serial, [this](const Message& message) {
          leave(message);
          admission_.leave(message->frame.bytes);
          return flow::continue_msg();
        }) {
    for (std::size_t i = 0; i < plan.nodes.size(); ++i) stations_.push_back(make_station(i));
    make_edges();
  }

  ~Runner() { graph_.wait_for_all(); }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  RunSummary run() {
    graph_.reserve_wait();
    std::thread source([this] {
      while (feed()) {
      }
      graph_.release_wait();
    });
    graph_.wait_for_all();
    source.join();
    if (source_error_) std::rethrow_exception(source_error_);
    if (error_) std::rethrow_exception(error_);
    if (entered_ != left_)
      throw std::logic_error("frames were lost: " + std::to_string(entered_) + " entered, " +
                             std::to_string(left_) + " left");
    summary_.stopped = summary_.stopped || !source_ended_;
    return summary_;
  }

 private:
  std::size_t tokens() const {
    if (options_.tokens > 0) return options_.tokens;
    return 2 * static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
  }

  /// To be called where an exception is caught: it ends the run and comes out of it.
  void end_by_exception() {
    const std::lock_guard lock(error_mutex_);
    if (!error_) error_ = std::current_exception();
    broken_ = halt_ = true;
  }

  bool halted() const { return halt_ || (options_.interrupted && options_.interrupted->load()); }

  /// Waits until a frame may enter, and has one enter. False if there is none.
  bool feed() {
    admission_.await_token();
    const Message message = next();
    if (!message) return false;
    admission_.enter(message->frame.bytes);
    entrance_.try_put(message);
    return true;
  }

  Message next() {
    try {
      std::optional<UntypedFrame> frame;
      if (!halted()) {
        frame = next_frame_();
        source_ended_ = !frame;
      }
      if (!frame) return nullptr;
      auto message = std::make_shared<FrameState>(entered_, std::move(*frame), plan_);
      ++entered_;
      handovers_.enter(message, go_on_);
      return message;
    } catch (...) {
      source_error_ = std::current_exception();
    }
    return nullptr;
  }

  Station make_station(std::size_t i) {
    if (plan_.nodes[i].constant) return {};
    const auto work = [this, i](const Message& message, Outlet& out) {
      visit(i, *message);
      handovers_.hand_on(i, message, go_on_);
      std::get<0>(out).try_put(message);
    };
    const bool in_order = detail::in_order(plan_.nodes[i]);
    Station station;
    station.entry = std::make_unique<Stage>(
        graph_, flow::unlimited, [this, i, in_order, work](const Message& message, Outlet& out) {
          if (!all_arrived(message, i)) return;
          if (in_order)
            std::get<0>(out).try_put(message);
          else
            work(message, out);
        });
    if (!in_order) return station;
    station.sorter = std::make_unique<flow::sequencer_node<Message>>(
        graph_, [](const Message& message) { return message->sequence; });
    station.serial = std::make_unique<Stage>(graph_, flow::serial, work);
    flow::make_edge(flow::output_port<0>(*station.entry), *station.sorter);
    flow::make_edge(*station.sorter, *station.serial);
    return station;
  }

  /// What no other node waits for leads to the nodes that run last; they, or it, to the gate.
  void make_edges() {
    std::vector<bool> leads_on(plan_.nodes.size(), false);
    for (std::size_t i = 0; i < stations_.size(); ++i)
      if (stations_[i].entry && !plan_.nodes[i].spec->last) lead_to(i, producers_of(i), leads_on);
    const std::vector<bool> leads_on_before = leads_on;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (!plan_.nodes[i].spec->last) continue;
      std::vector<int> producers = producers_of(i);
      for (std::size_t other = 0; other < stations_.size(); ++other)
        if (stations_[other].entry && !plan_.nodes[other].spec->last && !leads_on_before[other])
          producers.push_back(static_cast<int>(other));
      lead_to(i, std::move(producers), leads_on);
    }
    lead_to_gate(leads_on);
    flow::make_edge(flow::output_port<0>(gate_), order_);
    flow::make_edge(order_, sink_);
  }

  /// The nodes whose output node i reads, -1 for what comes with the frame.
  std::vector<int> producers_of(std::size_t i) const {
    std::vector<int> producers;
    for (const int input : awaited(plan_.nodes[i])) {
      const Stream& stream = plan_.streams[std::size_t(input)];
      if (!stream.constant) producers.push_back(stream.producer);
    }
    return producers;
  }

  /// One edge from each distinct producer; from the entrance for what comes with the frame, and for
  /// a node that waits for nothing.
  void lead_to(std::size_t i, std::vector<int> producers, std::vector<bool>& leads_on) {
    if (producers.empty()) producers.push_back(-1);
    std::sort(producers.begin(), producers.end());
    producers.erase(std::unique(producers.begin(), producers.end()), producers.end());
    expected_[i] = static_cast<int>(producers.size()) + count_previous(plan_.nodes[i]);
    for (const int producer : producers) {
      if (producer < 0) {
        flow::make_edge(entrance_, *stations_[i].entry);
      } else {
        flow::make_edge(stations_[std::size_t(producer)].exit(), *stations_[i].entry);
        leads_on[std::size_t(producer)] = true;
      }
    }
  }

  static int count_previous(const PlannedNode& node) {
    return static_cast<int>(node.inputs.size() - awaited(node).size());
  }

  void lead_to_gate(const std::vector<bool>& leads_on) {
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (!stations_[i].entry || leads_on[i]) continue;
      flow::make_edge(stations_[i].exit(), gate_);
      ++expected_.back();
    }
    if (expected_.back() > 0) return;
    flow::make_edge(entrance_, gate_);  // nothing but constants: frames pass straight through
    expected_.back() = 1;
  }

  /// True for the last of the edges that lead to a node (or to the gate).
  bool all_arrived(const Message& message, std::size_t at) const {
    return message->arrivals[at].fetch_add(1) + 1 == expected_[at];
  }

  void visit(std::size_t i, FrameState& state) {
    try {
      work_.visit(i, state);
    } catch (...) {
      end_by_exception();
    }
  }

  void leave(const Message& message) {
    ++left_;
    if (summary_.stopped || broken_) return;
    UntypedResult result = work_.result(*message);
    const bool failed = result.failure.has_value();
    ++(failed ? summary_.failed : summary_.done);
    try {
      on_result_(std::move(result));
    } catch (...) {
      end_by_exception();
    }
    if (failed && options_.stop_on_failure) summary_.stopped = halt_ = true;
  }

  /// What a node waited for is there.
  const std::function<void(std::size_t, const Message&)> go_on_ =
      [this](std::size_t node, const Message& message) { stations_[node].entry->try_put(message); };

  const Plan& plan_;
  const NextFrame& next_frame_;
  const RunOptions options_;
  const OnResult& on_result_;
  FrameWork work_;

  std::vector<int> expected_;  ///< per node, the last one for the gate: edges that lead there
  std::size_t entered_ = 0;
  std::size_t left_ = 0;
  bool source_ended_ = false;
  std::atomic<bool> halt_ = false;    ///< no frame enters any more
  std::atomic<bool> broken_ = false;  ///< and none is reported
  std::exception_ptr source_error_;
  std::mutex error_mutex_;
  std::exception_ptr error_;  ///< of a node or the receiver
  RunSummary summary_;

  flow::graph graph_;
  Admission admission_;
  detail::Handovers<Message> handovers_;
  flow::broadcast_node<Message> entrance_;
  std::vector<Station> stations_;
  Stage gate_;
  flow::sequencer_node<Message> order_;
  flow::function_node<Message, flow::continue_msg> sink_;
};

}  // namespace

RunSummary detail::run_flow(const Plan& plan, const Constants& constants, const NextFrame& source,
                            const RunOptions& options, const OnResult& on_result) {
  return Runner(plan, constants, source, options, on_result).run();
}

}  // namespace posevote::graph
