// SPDX-License-Identifier: BSD-3-Clause
// The registry of node types. A node is one .cpp file that ends in one expression:
//
//   const auto registered =
//       register_node("downsample_voxels", downsample_voxels, "One point per occupied voxel.")
//           .input("cloud").input("scale").output("cloud")
//           .param("leaf_size", &Params::leaf_size, "x resolution", "Edge of a voxel.",
//                  greater_than(0));
//
// The function is pure: `Out f(const In&..., const Params&)`. It may also take a `const
// FrameContext&` before its Params (writers need the output folder). An Out of void makes a node
// that only writes, a std::tuple one with several outputs. An In or Out of PerObject<T> means all
// objects of the frame; a plain T fed by a PerObject<T> stream is lifted: the function runs once
// per object, in parallel.
//
// A node that carries something from frame to frame keeps it in a state, which each run makes anew:
//
//   Out f(State&, const In&..., const Params&)
//   register_stateful_node<State>("smooth_poses", smooth_poses, "...")
//
// It sees the frames one by one, in their order. Frames that failed before they came to it are left
// out; `.on_failure(hook)` is told of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "graph/frame_context.hpp"
#include "graph/schema.hpp"
#include "graph/value.hpp"

// A plugin is built against one ABI of posevote, whose name CMake gives: with any other the loader
// refuses it, before anything of it runs.
#ifdef POSEVOTE_ABI
extern "C" const char POSEVOTE_ABI;
namespace {
[[gnu::used]] const char* const posevote_abi = &POSEVOTE_ABI;
}
#endif

namespace posevote::graph {

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
  std::vector<Port> outputs;  ///< none: the node only writes
  std::vector<ParamSpec> params;
  std::function<std::shared_ptr<void>()> make_params;
  /// A rule between parameters: "" or what is wrong.
  std::function<std::string(const void* params)> check;
  /// Makes what the node carries from frame to frame; empty where it carries nothing.
  std::function<std::shared_ptr<void>(const void* params)> make_state;
  /// Tells the state of a frame that failed before it came here; may be empty.
  std::function<void(void* state, const Failure& failure, const FrameContext& context,
                     const void* params)>
      on_failure;
  bool last = false;  ///< runs after all other nodes of the frame
  std::function<std::vector<Value>(const std::vector<Value>& inputs, const FrameContext& context,
                                   const void* params, void* state)>
      function;

  /// Runs the function; `state` is for a node that keeps one. Throws what the function throws.
  /// Returns a value for each output.
  std::vector<Value> call(const std::vector<Value>& values, const FrameContext& context,
                          const void* node_params, void* state = nullptr) const {
    return function(values, context, node_params, state);
  }
};

/// The node type of that name, or null. One that is not known yet is looked for in the libraries
/// that come with the program (graph/plugin.hpp).
const NodeSpec* find_node(const std::string& name);
/// All node types in alphabetical order, those of these libraries included.
std::vector<const NodeSpec*> all_nodes();
/// Adds a node type; a second one of the same name is a std::logic_error, from a plugin load_plugin's.
NodeSpec& add_node(NodeSpec spec);

namespace detail {

template <class T>
constexpr bool kIsContext = std::is_same_v<std::decay_t<T>, FrameContext>;

template <class T>
struct Outputs {
  static std::vector<Port> ports() { return {{"", StreamTraits<T>::type()}}; }
  static std::vector<Value> wrap(T&& value) { return {StreamTraits<T>::wrap(std::move(value))}; }
};
template <>
struct Outputs<void> {
  static std::vector<Port> ports() { return {}; }
};
template <class... T>
struct Outputs<std::tuple<T...>> {
  static std::vector<Port> ports() { return {{"", StreamTraits<T>::type()}...}; }
  static std::vector<Value> wrap(std::tuple<T...>&& values) {
    const auto each = [](T&&... value) {
      return std::vector<Value>{StreamTraits<T>::wrap(std::move(value))...};
    };
    return std::apply(each, std::move(values));
  }
};

/// Calls `function`, taking inputs in order from `values` and state, context and params where they
/// stand. State: void for a function without one.
template <class State, class Params, class R, class... Args, std::size_t... I>
std::vector<Value> invoke(R (*function)(Args...), const std::vector<Value>& values,
                          const FrameContext& context, const void* params,
                          [[maybe_unused]] void* state, std::index_sequence<I...>) {
  constexpr std::size_t kBefore = std::is_void_v<State> ? 0 : 1;
  const auto argument =
      [&]<std::size_t K>(std::integral_constant<std::size_t, K>) -> decltype(auto) {
    using Arg = std::decay_t<std::tuple_element_t<K, std::tuple<Args...>>>;
    if constexpr (K < kBefore)
      return *static_cast<State*>(state);
    else if constexpr (kIsContext<Arg>)
      return (context);
    else if constexpr (K + 1 == sizeof...(Args))
      return *static_cast<const Params*>(params);
    else
      return StreamTraits<Arg>::unwrap(values[K - kBefore]);
  };
  if constexpr (std::is_void_v<R>) {
    function(argument(std::integral_constant<std::size_t, I>{})...);
    return {};
  } else {
    return Outputs<R>::wrap(function(argument(std::integral_constant<std::size_t, I>{})...));
  }
}

}  // namespace detail

/// The fluent end of register_node and register_stateful_node.
template <class Params, class State = void>
class Registration {
 public:
  explicit Registration(NodeSpec& spec) : spec_(&spec) {}

  /// Names the next input port, in the order of the function's arguments.
  Registration& input(std::string name) {
    for (Port& port : spec_->inputs)
      if (port.name.empty()) return port.name = std::move(name), *this;
    throw std::logic_error(spec_->name + ": more input names than inputs");
  }
  /// Names the next output port, in the order of the function's result.
  Registration& output(std::string name) {
    for (Port& port : spec_->outputs)
      if (port.name.empty()) return port.name = std::move(name), *this;
    throw std::logic_error(spec_->name + ": more output names than outputs");
  }
  /// Runs when all other nodes of the frame are done, and knows what they took.
  Registration& last() {
    if (!spec_->outputs.empty())
      throw std::logic_error(spec_->name + ": runs last, but others may wait for its output");
    spec_->last = true;
    return *this;
  }
  /// Is told, in the frames' order, of each that failed before it came to this node.
  template <class S = State>
  Registration& on_failure(void (*hook)(S&, const Failure&, const FrameContext&, const Params&)) {
    spec_->on_failure = [hook](void* state, const Failure& failure, const FrameContext& context,
                               const void* params) {
      hook(*static_cast<S*>(state), failure, context, *static_cast<const Params*>(params));
    };
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

namespace detail {

template <class State, class R, class... Args>
auto register_function(std::string name, R (*function)(Args...), std::string doc,
                       const char* source) {
  using Params = std::decay_t<std::tuple_element_t<sizeof...(Args) - 1, std::tuple<Args...>>>;
  NodeSpec spec;
  spec.name = std::move(name);
  spec.doc = std::move(doc);
  spec.source = source;
  const auto add_input = [&spec]<class Arg>(std::type_identity<Arg>) {
    if constexpr (!kIsContext<Arg> && !std::is_same_v<Arg, Params> && !std::is_same_v<Arg, State>)
      spec.inputs.push_back({"", StreamTraits<Arg>::type()});
  };
  (add_input(std::type_identity<std::decay_t<Args>>{}), ...);
  spec.outputs = Outputs<R>::ports();
  spec.make_params = [] { return std::make_shared<Params>(); };
  spec.check = [](const void*) { return std::string(); };
  spec.function = [function](const std::vector<Value>& inputs, const FrameContext& context,
                             const void* params, void* state) {
    return invoke<State, Params>(function, inputs, context, params, state,
                                 std::index_sequence_for<Args...>{});
  };
  if constexpr (!std::is_void_v<State>)
    spec.make_state = []([[maybe_unused]] const void* params) -> std::shared_ptr<void> {
      if constexpr (std::is_constructible_v<State, const Params&>)
        return std::make_shared<State>(*static_cast<const Params*>(params));
      else
        return std::make_shared<State>();
    };
  return Registration<Params, State>(add_node(std::move(spec)));
}

}  // namespace detail

/// Registers `R function(const In&..., [const FrameContext&,] const Params&)` as a node type.
template <class R, class... Args>
auto register_node(std::string name, R (*function)(Args...), std::string doc,
                   const char* source = __builtin_FILE()) {
  return detail::register_function<void>(std::move(name), function, std::move(doc), source);
}

/// Registers `R function(State&, const In&..., [const FrameContext&,] const Params&)`. The state is
/// made anew for each run, from the Params where it can be.
template <class State, class R, class... Args>
auto register_stateful_node(std::string name, R (*function)(State&, Args...), std::string doc,
                            const char* source = __builtin_FILE()) {
  return detail::register_function<State>(std::move(name), function, std::move(doc), source);
}

}  // namespace posevote::graph
