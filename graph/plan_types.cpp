// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "graph/awaited.hpp"
#include "graph/planner.hpp"

namespace posevote::graph {
namespace {

/// Follows the types from the pipeline's inputs to its result.
class Types {
 public:
  Types(Plan& plan, const PipelineDescription& description, const PlanEnds& ends,
        std::vector<Problem>& problems)
      : plan_(plan), description_(description), ends_(ends), problems_(problems) {}

  void check() {
    for (PlannedNode& node : plan_.nodes) {
      node.lift.assign(node.inputs.size(), false);
      node.constant = !node.inputs.empty();
      for (std::size_t i = 0; i < node.inputs.size(); ++i) check_input(node, i);
      if (!node.spec) continue;
      if (node.spec->make_state || node.spec->last) node.constant = false;
      if (node.spec->make_state && node.lifted)
        report(node.where, node.name,
               "carries a state from frame to frame, so it takes the objects of a frame all at "
               "once, but would run for each object");
      for (std::size_t i = 0; i < node.outputs.size(); ++i) set_output(node, i);
    }
    for (const PlannedNode& node : plan_.nodes)
      for (std::size_t i = 0; i < node.inputs.size(); ++i)
        if (is_previous(node, i) && node.inputs[i] >= 0) check_previous(node, i);
    check_result();
    check_readers();
  }

 private:
  void report(const Location& where, std::string subject, std::string text) {
    problems_.push_back({where, std::move(subject), std::move(text)});
  }

  void set_output(const PlannedNode& node, std::size_t i) {
    if (node.outputs[i] < 0 || i >= node.spec->outputs.size()) return;
    Stream& out = plan_.streams[std::size_t(node.outputs[i])];
    out.constant = node.constant;
    out.type = node.spec->outputs[i].type;
    if (!node.lifted) return;
    if (out.type.per_object)
      report(node.where, node.name,
             "makes one " + out.type.name + " of one object, but would run for each object");
    out.type.per_object = true;
    out.type.name = "PerObject<" + out.type.name + ">";
  }

  void check_input(PlannedNode& node, std::size_t i) {
    if (node.inputs[i] < 0 || !node.spec) return void(node.constant = false);  // reported
    if (is_previous(node, i)) return void(node.constant = false);  // may be produced behind it
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

  /// Of what a node reads of the frame before.
  void check_previous(const PlannedNode& node, std::size_t i) {
    const Stream& stream = plan_.streams[std::size_t(node.inputs[i])];
    const Port& port = node.spec->inputs[i];
    const std::string subject = node.name + "." + port.name;
    if (stream.producer < 0 || stream.constant)
      return report(node.where, subject,
                    "reads '" + stream.name +
                        "' of the frame before, expected what a node makes of each frame");
    if (!stream.type.name.empty() && !is_previous_of(port.type, stream.type))
      report(node.where, subject,
             "expected " + port.type.name + ", but node " +
                 plan_.nodes[std::size_t(stream.producer)].name + " produces '" + stream.name +
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

  void check_readers() {
    for (std::size_t i = 0; i < plan_.streams.size(); ++i) {
      const Stream& stream = plan_.streams[i];
      if (!stream.consumers.empty() || stream.constant || !followers_of(plan_, i).empty()) continue;
      const Location& where = stream.producer >= 0 ? plan_.nodes[std::size_t(stream.producer)].where
                                                   : description_.where;
      report(where, stream.name, "nobody reads this stream, expected a reader or no such output");
    }
  }

  Plan& plan_;
  const PipelineDescription& description_;
  const PlanEnds& ends_;
  std::vector<Problem>& problems_;
};

}  // namespace

void detail::check_types(Plan& plan, const PipelineDescription& description, const PlanEnds& ends,
                         std::vector<Problem>& problems) {
  Types(plan, description, ends, problems).check();
}

}  // namespace posevote::graph
