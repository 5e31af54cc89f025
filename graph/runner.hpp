// SPDX-License-Identifier: BSD-3-Clause
// Runs a pipeline whose ends have known types over frames.
//
// A frame travels as one shared state. Each edge of the plan is an edge of the flow graph; a node
// runs when all the nodes that feed it have passed the frame on. Tokens bound the frames in flight.
// Every frame that enters leaves, in order, with its result or with the failure of the first node
// (in plan order) that failed; nodes behind a failed one are skipped.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "graph/flow.hpp"

namespace posevote::graph {

/// A plan that was checked to take an In... with each frame and to give a Result:
/// `Pipeline<Detections(SceneFile)>`.
template <class Signature>
struct Pipeline;

template <class Result, class... In>
struct Pipeline<Result(In...)> : Plan {
  /// What make_plan is to hold it to.
  static PlanEnds ends(std::string role, std::map<std::string, StreamType> constants = {}) {
    return {std::move(role),
            {StreamTraits<In>::type()...},
            StreamTraits<Result>::type(),
            std::move(constants)};
  }
};

/// make_plan for ends of known types; `role` and `constants` as in PlanEnds.
template <class Signature>
Pipeline<Signature> make_pipeline(const PipelineDescription& description, std::string role,
                                  const std::map<std::string, StreamType>& constants,
                                  std::vector<Problem>& problems) {
  return {make_plan(description, Pipeline<Signature>::ends(std::move(role), constants), problems)};
}

/// What enters.
template <class... In>
struct Frame {
  FrameContext context;
  std::tuple<In...> inputs;
  std::size_t bytes = 0;  ///< that it is expected to take: RunOptions::memory
  /// When it was there to be taken, where somebody waits for it. Nodes that run last are told the
  /// figure `latency_s`, how long ago that is.
  std::optional<std::chrono::steady_clock::time_point> since{};
};

/// What leaves: either the result or a failure.
template <class Result>
struct FrameResult {
  FrameContext context;
  std::shared_ptr<const Result> result;  ///< null where the frame failed
  std::optional<Failure> failure;
  std::vector<Span> spans;        ///< per node of the plan, in its order
  std::vector<Warning> warnings;  ///< in the plan's order, of a node each once
  Figures figures{};              ///< of all nodes
  std::optional<std::chrono::steady_clock::time_point> since{};  ///< as it entered
};

/// Gives the frames one by one, then nothing. Called by one thread at a time.
template <class... In>
using Source = std::function<std::optional<Frame<In...>>()>;

/// A source of `count` frames, make_frame(0) ... make_frame(count - 1).
template <class MakeFrame>
auto counted(std::size_t count, MakeFrame make_frame) {
  return [count, make_frame = std::move(make_frame),
          next = std::size_t(0)]() mutable -> std::optional<decltype(make_frame(count))> {
    if (next == count) return std::nullopt;
    return make_frame(next++);
  };
}

/// A value that is the same for every frame.
template <class T>
Constant constant(std::shared_ptr<const T> value) {
  return {StreamTraits<T>::type(), std::move(value)};
}

namespace detail {

template <class Result>
FrameResult<Result> typed(UntypedResult&& raw) {
  return {std::move(raw.context),
          raw.failure ? nullptr : StreamTraits<Result>::share(raw.result),
          std::move(raw.failure),
          std::move(raw.spans),
          std::move(raw.warnings),
          std::move(raw.figures),
          raw.since};
}

template <class... In>
UntypedFrame untyped(Frame<In...>&& frame) {
  return {
      std::move(frame.context),
      std::apply(
          [](auto&&... in) { return std::vector<Value>{StreamTraits<In>::wrap(std::move(in))...}; },
          std::move(frame.inputs)),
      frame.bytes, frame.since};
}

}  // namespace detail

/// Runs the frames of `source` through the pipeline. `on_result` receives the results in order, one
/// at a time. What either of them throws ends the run and is rethrown. `constants`: one for every
/// constant stream, from fold_constants; std::invalid_argument where one is missing or of another
/// type.
template <class Result, class... In>
RunSummary run(const Pipeline<Result(In...)>& pipeline, const Constants& constants,
               std::type_identity_t<Source<In...>> source, const RunOptions& options,
               const std::function<void(const FrameResult<Result>&)>& on_result) {
  const auto next = [&source]() -> std::optional<detail::UntypedFrame> {
    std::optional<Frame<In...>> frame = source();
    if (!frame) return std::nullopt;
    return detail::untyped(std::move(*frame));
  };
  return detail::run_flow(pipeline, constants, next, options,
                          [&on_result](detail::UntypedResult&& raw) {
                            on_result(detail::typed<Result>(std::move(raw)));
                          });
}

/// Runs one frame on the calling thread's arena and returns its result.
template <class Result, class... In>
FrameResult<Result> run_one(const Pipeline<Result(In...)>& pipeline, const Constants& constants,
                            std::type_identity_t<Frame<In...>> frame,
                            Activity* activity = nullptr) {
  FrameResult<Result> only;
  run(pipeline, constants, counted(1, [&frame](std::size_t) { return std::move(frame); }),
      {0, false, nullptr, activity},
      std::function([&only](const FrameResult<Result>& result) { only = result; }));
  return only;
}

}  // namespace posevote::graph
