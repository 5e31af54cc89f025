// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "graph/plan.hpp"

namespace posevote::graph {
namespace {

/// Turns a description into a plan, step by step, each step going on where others found problems.
class Planner {
 public:
  Planner(const PipelineDescription& description, const PlanEnds& ends,
          std::vector<Problem>& problems)
      : description_(description), ends_(ends), problems_(problems) {}

  Plan run() {
    plan_.name = description_.name;
    for (const auto& [name, type] : ends_.constants) add_stream({name, type, -1, true}, {});
    add_inputs();
    for (const NodeDescription& node : description_.nodes) add_node(node);
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) connect(static_cast<int>(i));
    find_result();
    sort();
    check_types();
    check_result();
    check_readers();
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

  void add_node(const NodeDescription& node) {
    PlannedNode planned;
    planned.name = node.name;
    planned.where = node.where;
    planned.like = !node.like.empty();
    planned.spec = find_type(node);
    if (planned.spec) {
      planned.params = planned.spec->make_params();
      set_parameters(planned, node);
    }
    const int index = static_cast<int>(plan_.nodes.size());
    plan_.nodes.push_back(std::move(planned));
    add_output(node, index);
  }

  const NodeSpec* find_type(const NodeDescription& node) {
    const NodeSpec* spec = find_node(node.type);
    if (spec || !node.like.empty()) return spec;  // resolve_likes or the original reports
    std::vector<std::string> known;
    for (const NodeSpec* other : all_nodes()) known.push_back(other->name);
    const std::string near = closest_name(node.type, known);
    report(node.where, node.name,
           "unknown node '" + node.type + "', " +
               (near.empty() ? "`posevote nodes` lists what there is"
                             : "did you mean '" + near + "'?"));
    return nullptr;
  }

  void set_parameters(PlannedNode& planned, const NodeDescription& node) {
    const bool own = !planned.like;  // else the original reports
    for (const auto& [key, setting] : node.settings) {
      const std::string subject = planned.name + "." + key;
      const auto param =
          std::find_if(planned.spec->params.begin(), planned.spec->params.end(),
                       [&key = key](const ParamSpec& spec) { return spec.name == key; });
      if (param == planned.spec->params.end()) {
        if (own) report(setting.where, subject, unknown_parameter(*planned.spec, key));
      } else if (const auto problem = param->set(planned.params.get(), setting.text)) {
        if (own)
          report(setting.where, subject,
                 "'" + setting.text + "' is not allowed, " + *problem +
                     (param->unit.empty() ? "" : " [" + param->unit + "]"));
      }
    }
    if (const std::string wrong = planned.spec->check(planned.params.get()); own && !wrong.empty())
      report(planned.where, planned.name, wrong);
  }

  static std::string unknown_parameter(const NodeSpec& spec, const std::string& key) {
    std::vector<std::string> known;
    for (const ParamSpec& param : spec.params) known.push_back(param.name);
    const std::string near = closest_name(key, known);
    if (!near.empty()) return "unknown parameter, did you mean '" + near + "'?";
    return "unknown parameter, `posevote nodes " + spec.name + "` lists what there is";
  }

  void add_output(const NodeDescription& node, int index) {
    PlannedNode& planned = plan_.nodes[std::size_t(index)];
    const bool has_output = !planned.spec || planned.spec->output;
    if (node.output && !has_output)
      return report(node.output->where, node.name, "only writes, expected no `out`");
    if (!node.output) {
      if (planned.spec && has_output)
        report(node.where, node.name,
               "expected `out`: a name for its " + planned.spec->output->type.name);
      return;
    }
    if (planned.spec && !node.output->port.empty() &&
        node.output->port != planned.spec->output->name)
      report(node.output->where, node.name,
             "has no output '" + node.output->port + "', expected '" + planned.spec->output->name +
                 "'");
    if (add_stream({node.output->stream, {}, index}, node.output->where))
      planned.output = static_cast<int>(plan_.streams.size()) - 1;
  }

  /// Finds the stream of each port of one node.
  void connect(int index) {
    PlannedNode& node = plan_.nodes[std::size_t(index)];
    const NodeDescription& description = description_.nodes[std::size_t(index)];
    const std::vector<Wire>& wires = description.inputs;
    if (!node.spec) {  // already reported; its inputs still count as readers
      for (const Wire& wire : wires) read_stream(wire, index);
      return;
    }
    node.inputs.assign(node.spec->inputs.size(), -1);
    for (std::size_t i = 0; i < wires.size(); ++i) {
      const int port = find_port(node, wires[i], i);
      const int stream = read_stream(wires[i], index);
      if (port >= 0) node.inputs[std::size_t(port)] = stream;
    }
    check_ports(node, description);
  }

  int find_port(const PlannedNode& node, const Wire& wire, std::size_t position) {
    const std::vector<Port>& ports = node.spec->inputs;
    if (wire.port.empty()) {
      if (position < ports.size()) return static_cast<int>(position);
      report(wire.where, node.name,
             "has " + std::to_string(ports.size()) + " inputs, '" + wire.stream + "' is one more");
      return -1;
    }
    std::vector<std::string> known;
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (ports[i].name == wire.port) return static_cast<int>(i);
      known.push_back(ports[i].name);
    }
    const std::string near = closest_name(wire.port, known);
    report(wire.where, node.name,
           "has no input '" + wire.port + "'" +
               (near.empty() ? "" : ", did you mean '" + near + "'?"));
    return -1;
  }

  int read_stream(const Wire& wire, int reader) {
    const auto found = stream_of_.find(wire.stream);
    if (found != stream_of_.end()) {
      plan_.streams[std::size_t(found->second)].consumers.push_back(reader);
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
    if (!description_.result.stream.empty()) plan_.result = read_stream(description_.result, -1);
  }

  void check_readers() {
    for (const Stream& stream : plan_.streams) {
      if (!stream.consumers.empty() || stream.constant) continue;
      const Location& where = stream.producer >= 0 ? plan_.nodes[std::size_t(stream.producer)].where
                                                   : description_.where;
      report(where, stream.name, "nobody reads this stream, expected a reader or no such output");
    }
  }

  /// Orders the nodes so that producers come first, else in the order in which they are written.
  void sort() {
    std::vector<int> order;
    std::vector<bool> placed(plan_.nodes.size(), false);
    const auto ready = [&](std::size_t i) {
      return std::all_of(plan_.nodes[i].inputs.begin(), plan_.nodes[i].inputs.end(), [&](int s) {
        const int producer = s < 0 ? -1 : plan_.streams[std::size_t(s)].producer;
        return producer < 0 || placed[std::size_t(producer)];
      });
    };
    for (bool moved = true; moved;) {
      moved = false;
      for (std::size_t i = 0; i < plan_.nodes.size() && !moved; ++i) {
        if (placed[i] || !ready(i)) continue;
        placed[i] = moved = true;
        order.push_back(static_cast<int>(i));
      }
    }
    if (order.size() < plan_.nodes.size()) report_cycle(placed);
    for (std::size_t i = 0; i < placed.size(); ++i)
      if (!placed[i]) order.push_back(static_cast<int>(i));
    reorder(order);
  }

  void report_cycle(const std::vector<bool>& placed) {
    std::string members;
    for (std::size_t i = 0; i < placed.size(); ++i)
      if (!placed[i]) members += (members.empty() ? "" : ", ") + plan_.nodes[i].name;
    const auto first = std::find(placed.begin(), placed.end(), false) - placed.begin();
    const PlannedNode& node = plan_.nodes[static_cast<std::size_t>(first)];
    report(node.where, node.name, "waits for itself: a cycle through or before " + members);
  }

  void reorder(const std::vector<int>& order) {
    std::vector<PlannedNode> nodes;
    std::vector<int> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      place[std::size_t(order[i])] = static_cast<int>(i);
      nodes.push_back(std::move(plan_.nodes[std::size_t(order[i])]));
    }
    plan_.nodes = std::move(nodes);
    for (Stream& stream : plan_.streams) {
      if (stream.producer >= 0) stream.producer = place[std::size_t(stream.producer)];
      for (int& consumer : stream.consumers)
        if (consumer >= 0) consumer = place[std::size_t(consumer)];
    }
  }

  void check_types() {
    for (PlannedNode& node : plan_.nodes) {
      node.lift.assign(node.inputs.size(), false);
      node.constant = !node.inputs.empty();
      for (std::size_t i = 0; i < node.inputs.size(); ++i) check_input(node, i);
      if (node.output < 0 || !node.spec) continue;
      Stream& out = plan_.streams[std::size_t(node.output)];
      out.constant = node.constant;
      out.type = node.spec->output->type;
      if (!node.lifted) continue;
      if (out.type.per_object)
        report(node.where, node.name,
               "makes one " + out.type.name + " of one object, but would run for each object");
      out.type.per_object = true;
      out.type.name = "PerObject<" + out.type.name + ">";
    }
  }

  void check_input(PlannedNode& node, std::size_t i) {
    if (node.inputs[i] < 0) return void(node.constant = false);  // already reported
    Stream& stream = plan_.streams[std::size_t(node.inputs[i])];
    const Port& port = node.spec->inputs[i];
    node.constant = node.constant && stream.constant;
    if (stream.type.name.empty() || stream.type == port.type) return;
    if (stream.type.per_object && !port.type.per_object &&
        stream.type.element == port.type.element) {
      node.lift[i] = node.lifted = true;
      return;
    }
    if (stream.producer < 0 && !stream.constant) return report_input(stream, node, port);
    const std::string producer =
        stream.producer < 0 ? "the run" : "node " + plan_.nodes[std::size_t(stream.producer)].name;
    report(node.where, node.name + "." + port.name,
           "expected " + port.type.name + ", but " + producer + " produces '" + stream.name +
               "' as " + stream.type.name);
  }

  /// Where it is named an input, since it may be another node that should read it.
  void report_input(const Stream& stream, const PlannedNode& reader, const Port& port) {
    for (const Wire& wire : description_.inputs)
      if (wire.stream == stream.name)
        report(wire.where, stream.name,
               "comes as " + stream.type.name + " with each frame of " + ends_.role + ", but " +
                   reader.name + "." + port.name + " expects " + port.type.name);
  }

  void check_result() {
    if (plan_.result < 0) return;  // reported
    const StreamType& type = plan_.streams[std::size_t(plan_.result)].type;
    if (!type.name.empty() && !(type == ends_.result))
      report(description_.result.where, "result",
             "'" + description_.result.stream + "' is " + type.name + ", expected " +
                 ends_.result.name + ", which " + ends_.role + " gives");
  }

  const PipelineDescription& description_;
  const PlanEnds& ends_;
  std::vector<Problem>& problems_;
  Plan plan_;
  std::map<std::string, int> stream_of_;
};

}  // namespace

Plan make_plan(const PipelineDescription& description, const PlanEnds& ends,
               std::vector<Problem>& problems) {
  return Planner(description, ends, problems).run();
}

}  // namespace posevote::graph
