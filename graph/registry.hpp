// SPDX-License-Identifier: BSD-3-Clause
// The registry of node types. A node is one .cpp file that ends in one expression:
//
//   const auto registered =
//       register_node("downsample_voxels", downsample_voxels, "One point per occupied voxel.")
//           .input("cloud").input("scale").output("cloud")
//           .param("leaf_size", &Params::leaf_size, "x resolution", "Edge of a voxel.",
//           greater_than(0));
//
// The function is pure: `Out f(const In&..., const Params&)`. It may also take a `const
// FrameContext&` before its Params (writers need the output folder). An Out of void makes a node
// that only writes. An In or Out of PerObject<T> means all objects of the frame; a plain T fed by a
// PerObject<T> stream is lifted: the function runs once per object, in parallel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "graph/schema.hpp"
#include "graph/value.hpp"

namespace posevote::graph {

/// What a node may know about its frame beyond its inputs.
struct FrameContext {
  std::uint64_t number = 0;   ///< of the frame in this run
  std::string name;           ///< for file names: unique within a run, made from the scene's path
  std::filesystem::path out;  ///< output folder of the run; empty where nothing is to be written
  std::uint64_t seed = 0;     ///< the user's seed
};

struct Port {
  std::string name;
  StreamType type;
};

/// A node type: everything the builder, the help and the documentation need to know.
struct NodeSpec {
  std::string name;
  std::string doc;
  std::string source;  ///< file that registered it
  std::vector<Port> inputs;
  std::optional<Port> output;  ///< none: the node only writes
  std::vector<ParamSpec> params;
  std::function<std::shared_ptr<void>()> make_params;
  /// A rule between parameters: "" or what is wrong.
  std::function<std::string(const void* params)> check;
  /// Runs the function. Throws what the function throws. Returns null for a node that only writes.
  std::function<Value(const std::vector<Value>& inputs, const FrameContext& context,
                      const void* params)>
      call;
};

/// The node type of that name, or null.
const NodeSpec* find_node(const std::string& name);
/// All node types in alphabetical order.
std::vector<const NodeSpec*> all_nodes();
/// Adds a node type; a second one of the same name is a std::logic_error.
NodeSpec& add_node(NodeSpec spec);

namespace detail {

template <class T>
constexpr bool kIsContext = std::is_same_v<std::decay_t<T>, FrameContext>;

/// Calls `function`, taking inputs in order from `values` and context and params where they stand.
template <class Params, class R, class... Args, std::size_t... I>
Value invoke(R (*function)(Args...), const std::vector<Value>& values, const FrameContext& context,
             const void* params, std::index_sequence<I...>) {
  const auto argument =
      [&]<std::size_t K>(std::integral_constant<std::size_t, K>) -> decltype(auto) {
    using Arg = std::decay_t<std::tuple_element_t<K, std::tuple<Args...>>>;
    if constexpr (kIsContext<Arg>)
      return (context);
    else if constexpr (K + 1 == sizeof...(Args))
      return *static_cast<const Params*>(params);
    else
      return StreamTraits<Arg>::unwrap(values[K]);
  };
  if constexpr (std::is_void_v<R>) {
    function(argument(std::integral_constant<std::size_t, I>{})...);
    return nullptr;
  } else {
    return StreamTraits<R>::wrap(function(argument(std::integral_constant<std::size_t, I>{})...));
  }
}

}  // namespace detail

/// The fluent end of register_node.
template <class Params>
class Registration {
 public:
  explicit Registration(NodeSpec& spec) : spec_(&spec) {}

  /// Names the next input port, in the order of the function's arguments.
  Registration& input(std::string name) {
    for (Port& port : spec_->inputs)
      if (port.name.empty()) return port.name = std::move(name), *this;
    throw std::logic_error(spec_->name + ": more input names than inputs");
  }
  /// Names the output port.
  Registration& output(std::string name) {
    if (!spec_->output) throw std::logic_error(spec_->name + ": names an output but returns void");
    spec_->output->name = std::move(name);
    return *this;
  }
  /// `access`: a member pointer, or a function from Params& to a reference to what lies deeper.
  template <class Access>
  Registration& param(std::string name, Access access, std::string unit, std::string doc,
                      Constraint constraint = anything()) {
    spec_->params.push_back(make_param<Params>(std::move(name), std::move(access), std::move(unit),
                                               std::move(doc), std::move(constraint)));
    return *this;
  }
  /// A parameter that is listed apart, for those who know the method from within.
  template <class Access>
  Registration& expert_param(std::string name, Access access, std::string unit, std::string doc,
                             Constraint constraint = anything()) {
    param(std::move(name), std::move(access), std::move(unit), std::move(doc),
          std::move(constraint));
    spec_->params.back().expert = true;
    return *this;
  }
  /// A rule between parameters: `std::string rule(const Params&)` returns "" or what is wrong.
  Registration& check(std::string (*rule)(const Params&)) {
    spec_->check = [rule](const void* params) { return rule(*static_cast<const Params*>(params)); };
    return *this;
  }

 private:
  NodeSpec* spec_;
};

/// Registers `R function(const In&..., [const FrameContext&,] const Params&)` as a node type.
template <class R, class... Args>
auto register_node(std::string name, R (*function)(Args...), std::string doc,
                   const char* source = __builtin_FILE()) {
  using Params = std::decay_t<std::tuple_element_t<sizeof...(Args) - 1, std::tuple<Args...>>>;
  NodeSpec spec;
  spec.name = std::move(name);
  spec.doc = std::move(doc);
  spec.source = source;
  const auto add_input = [&spec]<class Arg>(std::type_identity<Arg>) {
    if constexpr (!detail::kIsContext<Arg> && !std::is_same_v<Arg, Params>)
      spec.inputs.push_back({"", StreamTraits<Arg>::type()});
  };
  (add_input(std::type_identity<std::decay_t<Args>>{}), ...);
  if constexpr (!std::is_void_v<R>) spec.output = Port{"", StreamTraits<R>::type()};
  spec.make_params = [] { return std::make_shared<Params>(); };
  spec.check = [](const void*) { return std::string(); };
  spec.call = [function](const std::vector<Value>& inputs, const FrameContext& context,
                         const void* params) {
    return detail::invoke<Params>(function, inputs, context, params,
                                  std::index_sequence_for<Args...>{});
  };
  return Registration<Params>(add_node(std::move(spec)));
}

}  // namespace posevote::graph
