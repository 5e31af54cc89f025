// SPDX-License-Identifier: BSD-3-Clause
#include "graph/variation.hpp"

#include <algorithm>

#include "graph/schema.hpp"

namespace posevote::graph {
namespace {

using Nodes = std::vector<NodeDescription>;

Nodes::iterator find(Nodes& nodes, const std::string& name) {
  return std::find_if(nodes.begin(), nodes.end(),
                      [&name](const NodeDescription& node) { return node.name == name; });
}

void report_missing(const Wire& named, const std::string& what,
                    const std::vector<std::string>& known, std::vector<Problem>& problems) {
  const std::string near = closest_name(named.stream, known);
  problems.push_back(
      {named.where, named.stream, what + (near.empty() ? "" : ", did you mean '" + near + "'?")});
}

/// Where the node stands that is named there; the end and a problem where there is none.
Nodes::iterator find(PipelineDescription& pipeline, const Wire& named,
                     std::vector<Problem>& problems) {
  const auto found = find(pipeline.nodes, named.stream);
  if (found != pipeline.nodes.end()) return found;
  std::vector<std::string> known;
  for (const NodeDescription& node : pipeline.nodes) known.push_back(node.name);
  report_missing(named, "no such node in the pipeline that this one extends", known, problems);
  return found;
}

/// False, and a problem, where another node has that name.
bool check_free(PipelineDescription& pipeline, const NodeDescription& node,
                std::vector<Problem>& problems) {
  const auto found = find(pipeline.nodes, node.name);
  if (found == pipeline.nodes.end()) return true;
  problems.push_back({node.where, node.name,
                      "the pipeline has a node of that name, in " + to_string(found->where) +
                          "; expected another, or `replace`"});
  return false;
}

/// All ends at which streams are read, of nodes and of the pipeline.
std::vector<Wire*> readers(PipelineDescription& pipeline) {
  std::vector<Wire*> ends;
  for (NodeDescription& node : pipeline.nodes)
    for (Wire& input : node.inputs) ends.push_back(&input);
  if (!pipeline.result.stream.empty()) ends.push_back(&pipeline.result);
  return ends;
}

bool has(const std::vector<Wire>& wires, const std::string& stream) {
  return std::any_of(wires.begin(), wires.end(),
                     [&stream](const Wire& wire) { return wire.stream == stream; });
}

/// Behind the stream's producer; what comes with the frame or with the models is there from the
/// beginning.
Nodes::iterator behind_producer(Nodes& nodes, const std::string& stream) {
  const auto producer =
      std::find_if(nodes.begin(), nodes.end(),
                   [&stream](const NodeDescription& node) { return has(node.outputs, stream); });
  return producer == nodes.end() ? nodes.begin() : std::next(producer);
}

/// Puts the node between a stream and those that read it. What its `in` and `out` leave unsaid: it
/// reads that stream, and what it makes is called like itself.
void insert_into(PipelineDescription& pipeline, NodeDescription node, const Wire& into,
                 std::vector<Problem>& problems) {
  const auto report = [&](const std::string& text) {
    problems.push_back({into.where, node.name, text});
  };
  if (node.inputs.empty()) node.inputs = {into};
  if (node.outputs.empty()) node.outputs = {{"", node.name, node.where}};
  if (!has(node.inputs, into.stream))
    return report("is put into '" + into.stream + "' but does not read it");
  if (node.outputs.size() != 1)
    return report("is put into '" + into.stream + "', expected one stream in `out`");
  bool was_read = false;
  std::vector<std::string> known;
  for (Wire* reader : readers(pipeline)) {
    known.push_back(reader->stream);
    if (reader->stream != into.stream) continue;
    was_read = true;
    reader->stream = node.outputs.front().stream;
  }
  if (!was_read)
    return report_missing(into, "nothing in the pipeline that this one extends reads such a stream",
                          known, problems);
  pipeline.nodes.insert(behind_producer(pipeline.nodes, into.stream), std::move(node));
}

void insert(PipelineDescription& pipeline, const Variation::Insertion& insertion,
            std::vector<Problem>& problems) {
  using Place = Variation::Place;
  const auto& [node, place, at] = insertion;
  if (!check_free(pipeline, node, problems)) return;
  if (place == Place::kInto) return insert_into(pipeline, node, at, problems);
  auto next = pipeline.nodes.end();
  if (place != Place::kAtEnd) {
    next = find(pipeline, at, problems);
    if (next != pipeline.nodes.end() && place == Place::kAfter) ++next;
  }
  pipeline.nodes.insert(next, node);
}

}  // namespace

void vary(PipelineDescription& pipeline, const Variation& variation,
          std::vector<Problem>& problems) {
  Nodes& nodes = pipeline.nodes;
  for (const Wire& removed : variation.removed)
    if (const auto place = find(pipeline, removed, problems); place != nodes.end())
      nodes.erase(place);
  for (const auto& [replaced, node] : variation.replaced) {
    const auto place = find(pipeline, replaced, problems);
    if (place == nodes.end()) continue;
    if (node.name == place->name || check_free(pipeline, node, problems)) *place = node;
  }
  for (const Variation::Insertion& insertion : variation.inserted)
    insert(pipeline, insertion, problems);
}

}  // namespace posevote::graph
