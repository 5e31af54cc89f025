// SPDX-License-Identifier: BSD-3-Clause
#include "graph/node_call.hpp"

#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "graph/parallel.hpp"

namespace posevote::graph {
namespace {

const Slots& slots_of(const Value& value) { return *static_cast<const Slots*>(value.get()); }

/// How many objects the lifted inputs have; they must agree.
std::size_t count_objects(const PlannedNode& node, const std::vector<Value>& inputs) {
  std::size_t count = 0;
  bool known = false;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!node.lift[i]) continue;
    const std::size_t size = slots_of(inputs[i]).size();
    if (known && size != count)
      throw std::logic_error("its inputs have different numbers of objects: " +
                             std::to_string(count) + " and " + std::to_string(size));
    count = size;
    known = true;
  }
  return count;
}

std::vector<Value> call_lifted(const PlannedNode& node, const std::vector<Value>& inputs,
                               const FrameContext& context, Activity::Call* call) {
  const std::size_t count = count_objects(node, inputs);
  if (call) call->begin_objects(count);
  std::vector<Slots> outputs(node.outputs.size(), Slots(count));
  std::vector<std::optional<std::string>> errors(count);
  parallel_for(count, 1, [&](std::size_t object) {
    if (call && call->is_cancelled()) return;
    std::vector<Value> arguments = inputs;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      if (node.lift[i]) arguments[i] = slots_of(inputs[i])[object];
    try {
      const std::vector<Value> values = node.spec->call(arguments, context, node.params.get());
      for (std::size_t i = 0; i < values.size(); ++i) outputs[i][object] = values[i];
    } catch (const std::exception& error) {
      errors[object] = reason_of(error);
    }
    if (call) call->end_object();
  });
  if (call && call->is_cancelled()) throw Cancelled();
  std::vector<ObjectFailure> failed;
  for (std::size_t object = 0; object < count; ++object)
    if (errors[object]) failed.push_back({object, *errors[object]});
  if (!failed.empty()) {
    const std::string first = std::to_string(failed[0].object + 1);
    throw ObjectErrors(failed, "object " + first + ": " + failed[0].cause);
  }
  std::vector<Value> values;
  for (Slots& slots : outputs) values.push_back(std::make_shared<const Slots>(std::move(slots)));
  return values;
}

}  // namespace

std::string reason_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return "out of memory";
  // The standard library's own text names a function: "vector::_M_fill_insert".
  if (dynamic_cast<const std::length_error*>(&error))
    return "a list would be longer than memory can address: is a parameter or a size in the file "
           "too large?";
  return error.what();
}

std::vector<Value> call_node(const PlannedNode& node, const std::vector<Value>& inputs,
                             const FrameContext& context, void* state, Activity::Call* call) {
  if (call && call->is_cancelled()) throw Cancelled();
  if (node.lifted) return call_lifted(node, inputs, context, call);
  return node.spec->call(inputs, context, node.params.get(), state);
}

}  // namespace posevote::graph
