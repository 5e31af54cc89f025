// SPDX-License-Identifier: BSD-3-Clause
#include "graph/planner.hpp"

#include <algorithm>

#include "graph/previous.hpp"

namespace posevote::graph {
namespace {

/// Links nodes by the names of streams.
class Wiring {
 public:
  Wiring(const PipelineDescription& description, const PlanEnds& ends,
         std::vector<Problem>& problems)
      : description_(description), ends_(ends), problems_(problems) {}

  Plan run() {
    plan_.name = description_.name;
    for (const auto& [name, type] : ends_.constants) add_stream({name, type, -1, true}, {});
    add_inputs();
    for (const NodeDescription& node : description_.nodes) {
      plan_.nodes.push_back(detail::plan_node(node, problems_));
      add_outputs(node, static_cast<int>(plan_.nodes.size()) - 1);
    }
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) connect(static_cast<int>(i));
    find_result();
    return std::move(plan_);
  }

 private:
  void report(const Location& where, std::string subject, std::string text) {
    problems_.push_back({where, std::move(subject), std::move(text)});
  }

  /// False, and a problem, if somebody else produces a stream of that name.
  bool add_stream(Stream stream, const Location& where) {
    const auto [place, is_new] =
        stream_of_.emplace(stream.name, static_cast<int>(plan_.streams.size()));
    if (is_new) {
      plan_.streams.push_back(std::move(stream));
      return true;
    }
    const auto producer = [this](const Stream& of) {
      if (of.producer >= 0) return "node " + plan_.nodes[std::size_t(of.producer)].name;
      return std::string("the pipeline's inputs");
    };
    report(where, stream.name,
           "produced twice, by " + producer(plan_.streams[std::size_t(place->second)]) +
               " and by " + producer(stream) + ", expected one producer a stream");
    return false;
  }

  void add_inputs() {
    const std::vector<Wire>& wires = description_.inputs;
    if (!wires.empty() && wires.size() != ends_.inputs.size()) {
      std::string expected;
      for (const StreamType& type : ends_.inputs)
        expected += (expected.empty() ? "" : ", ") + type.name;
      report(description_.inputs_where, "inputs",
             std::to_string(wires.size()) + " streams, but each frame of " + ends_.role +
                 " brings " + std::to_string(ends_.inputs.size()) + ": " + expected);
    }
    for (std::size_t i = 0; i < wires.size(); ++i) {
      const StreamType type = i < ends_.inputs.size() ? ends_.inputs[i] : StreamType{};
      add_stream({wires[i].stream, type, -1}, wires[i].where);
      plan_.inputs.push_back(stream_of_[wires[i].stream]);
    }
  }

  void add_outputs(const NodeDescription& node, int index) {
    PlannedNode& planned = plan_.nodes[std::size_t(index)];
    if (planned.spec) {
      planned.outputs.assign(planned.spec->outputs.size(), -1);
      if (!planned.outputs.empty() && node.outputs.empty())
        report(node.where, node.name, "expected `out`: a name for its " + types_of(*planned.spec));
      if (planned.outputs.empty() && !node.outputs.empty())
        return report(node.outputs[0].where, node.name, "only writes, expected no `out`");
    }
    for (std::size_t i = 0; i < node.outputs.size(); ++i) {
      const Wire& wire = node.outputs[i];
      const int port =
          planned.spec ? find_port(planned, "output", planned.spec->outputs, wire, i) : -1;
      if (add_stream({wire.stream, {}, index}, wire.where) && port >= 0)
        planned.outputs[std::size_t(port)] = static_cast<int>(plan_.streams.size()) - 1;
    }
  }

  static std::string types_of(const NodeSpec& spec) {
    std::string types;
    for (const Port& port : spec.outputs) types += (types.empty() ? "" : ", ") + port.type.name;
    return types;
  }

  /// Finds the stream of each port of one node.
  void connect(int index) {
    PlannedNode& node = plan_.nodes[std::size_t(index)];
    const NodeDescription& description = description_.nodes[std::size_t(index)];
    const std::vector<Wire>& wires = description.inputs;
    if (!node.spec) {  // already reported; its inputs still count as readers
      for (const Wire& wire : wires) read_stream(wire, index, false);
      return;
    }
    node.inputs.assign(node.spec->inputs.size(), -1);
    for (std::size_t i = 0; i < wires.size(); ++i) {
      const int port = find_port(node, "input", node.spec->inputs, wires[i], i);
      const int stream = read_stream(
          wires[i], index, port >= 0 && is_previous(node.spec->inputs[std::size_t(port)].type));
      if (port >= 0) node.inputs[std::size_t(port)] = stream;
    }
    check_ports(node, description);
  }

  /// The place of a wire's port among `ports`, or -1 and a problem. `kind`: "input" or "output".
  int find_port(const PlannedNode& node, const std::string& kind, const std::vector<Port>& ports,
                const Wire& wire, std::size_t position) {
    if (wire.port.empty()) {
      if (position < ports.size()) return static_cast<int>(position);
      report(wire.where, node.name,
             "has " + std::to_string(ports.size()) + " " + kind + "s, '" + wire.stream +
                 "' is one more");
      return -1;
    }
    std::vector<std::string> known;
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (ports[i].name == wire.port) return static_cast<int>(i);
      known.push_back(ports[i].name);
    }
    const std::string near = closest_name(wire.port, known);
    report(wire.where, node.name,
           "has no " + kind + " '" + wire.port + "'" +
               (near.empty() ? "" : ", did you mean '" + near + "'?"));
    return -1;
  }

  int read_stream(const Wire& wire, int reader, bool with_next_frame) {
    const auto found = stream_of_.find(wire.stream);
    if (found != stream_of_.end()) {
      if (!with_next_frame) plan_.streams[std::size_t(found->second)].consumers.push_back(reader);
      return found->second;
    }
    std::vector<std::string> known;
    for (const auto& [name, index] : stream_of_) known.push_back(name);
    const std::string near = closest_name(wire.stream, known);
    report(wire.where, reader >= 0 ? plan_.nodes[std::size_t(reader)].name : "result",
           "nobody produces the stream '" + wire.stream + "'" +
               (near.empty() ? "" : ", did you mean '" + near + "'?"));
    return -1;
  }

  void check_ports(const PlannedNode& node, const NodeDescription& description) {
    for (std::size_t i = 0; i < node.inputs.size(); ++i) {
      const Port& port = node.spec->inputs[i];
      const bool named = std::any_of(description.inputs.begin(), description.inputs.end(),
                                     [&](const Wire& wire) { return wire.port == port.name; });
      if (node.inputs[i] < 0 && !named && i >= description.inputs.size())
        report(
            node.where, node.name,
            "input '" + port.name + "' is not connected, expected a stream of " + port.type.name);
    }
  }

  void find_result() {
    if (!description_.result.stream.empty())
      plan_.result = read_stream(description_.result, -1, false);
  }

  const PipelineDescription& description_;
  const PlanEnds& ends_;
  std::vector<Problem>& problems_;
  Plan plan_;
  std::map<std::string, int> stream_of_;
};

}  // namespace

Plan detail::wire(const PipelineDescription& description, const PlanEnds& ends,
                  std::vector<Problem>& problems) {
  return Wiring(description, ends, problems).run();
}

Plan make_plan(const PipelineDescription& description, const PlanEnds& ends,
               std::vector<Problem>& problems) {
  Plan plan = detail::wire(description, ends, problems);
  detail::order_nodes(plan, problems);
  detail::check_types(plan, description, ends, problems);
  return plan;
}

}  // namespace posevote::graph
