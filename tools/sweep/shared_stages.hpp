// SPDX-License-Identifier: BSD-3-Clause
// A frame through many pipelines that differ in some parameters: what has the same type, parameters
// and inputs in several of them runs once.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/plan.hpp"

namespace posevote::sweep {

class SharedStages {
 public:
  /// A pipeline, and the constants that it is given, by stream: the same pointer is the same value.
  struct Variant {
    const graph::Plan* plan = nullptr;
    std::map<std::string, graph::Value> constants;
  };

  /// Of a variant and a frame.
  struct Outcome {
    graph::Value result;                 ///< null where the frame failed
    std::optional<std::string> failure;  ///< "node: what"
    double seconds = 0;                  ///< of all nodes before the result, shared ones in full
  };

  /// Runs the nodes that depend on constants alone. Keeps the plans' addresses. Throws
  /// std::invalid_argument for a node that carries something from frame to frame, and
  /// std::runtime_error "node: what" for one that fails.
  explicit SharedStages(std::vector<Variant> variants);

  /// One for each variant. `inputs`: in the plans' order. A value is kept until the last variant
  /// that reads it is done.
  std::vector<Outcome> run(const std::vector<graph::Value>& inputs,
                           const graph::FrameContext& context);

  /// Two variants whose answers are the same whatever the frame have the same number.
  std::size_t answer_of(std::size_t variant) const { return ways_[variant].answer; }

  /// How often each node was to run, and did, by name; nodes that write are none of them.
  struct Calls {
    std::size_t asked = 0, made = 0;
  };
  using AllCalls = std::map<std::string, Calls>;
  /// Those since it was asked last.
  AllCalls take_calls() { return std::exchange(calls_, {}); }

 private:
  struct Step {
    const graph::PlannedNode* node = nullptr;
    std::size_t id = 0;  ///< the same for nodes that make the same
  };
  /// A variant, prepared.
  struct Way {
    const graph::Plan* plan = nullptr;
    std::vector<graph::Value> constants;  ///< by stream
    std::vector<Step> steps;              ///< in an order in which they can run
    std::size_t answer = 0;               ///< id of the result
  };
  struct Made {
    std::vector<graph::Value> values;
    std::optional<std::string> failure;
    double seconds = 0;
  };
  using Cache = std::map<std::size_t, Made>;

  std::size_t id_of(const std::string& text);
  std::size_t id_of(const graph::PlannedNode& node, const std::vector<std::size_t>& streams);
  Way prepare(const Variant& variant, Cache& folded);
  const Made& make(const Step& step, const graph::FrameContext& context,
                   std::vector<graph::Value>& values, Cache& cache);
  Outcome follow(const Way& way, const std::vector<graph::Value>& inputs,
                 const graph::FrameContext& context, Cache& cache);

  std::map<std::string, std::size_t> ids_;
  std::vector<Way> ways_;
  std::map<std::size_t, std::size_t> last_;  ///< by id: the last way that has such a step
  AllCalls calls_;
};

}  // namespace posevote::sweep
