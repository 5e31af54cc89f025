// SPDX-License-Identifier: BSD-3-Clause
// What `posevote run` tells of its frames as they leave, and trace.json.
#pragma once

#include <cstddef>

#include "graph/runner.hpp"
#include "nodes/data/detections.hpp"
#include "tools/commands.hpp"
#include "tools/progress/progress.hpp"

namespace posevote {

/// Up to so many frames each has its lines; of more, a line shows how far the run is.
constexpr std::size_t kFewFrames = 20;

/// Warnings and failures always; what was found in each frame where there are few, or for -v, with
/// what was measured of it. Used by one thread at a time.
class FrameReport {
 public:
  /// `count`: frames to come; 0 where nobody knows. `activity` and `interrupted` of the run.
  FrameReport(const RunCommand& command, const graph::Plan& plan, std::size_t count,
              const graph::Activity& activity, const std::atomic<bool>& interrupted);

  void add(const graph::FrameResult<Detections>& result);
  /// Ends trace.json; for -v tells what each node took.
  void finish();
  std::size_t found() const { return found_; }  ///< instances in all frames so far

 private:
  void say(const graph::FrameResult<Detections>& result) const;

  const RunCommand& command_;
  const std::size_t count_;
  graph::Trace trace_;
  std::size_t reported_ = 0, failed_ = 0, found_ = 0;
  Progress progress_;
};

}  // namespace posevote
