// SPDX-License-Identifier: BSD-3-Clause
// Time that is shared among all who work at the moment: a frame that has the machine for itself
// takes as long as it takes, four at once are charged a quarter each. So what a frame costs does not
// grow with the frames in flight, and all frames together cost what the run takes.
#pragma once

#include <chrono>
#include <mutex>

namespace posevote::graph::detail {

class SharedClock {
 public:
  /// Somebody begins to work. What this returns is for end().
  double begin() {
    const std::lock_guard lock(mutex_);
    advance();
    ++working_;
    return shared_;
  }

  /// Who began at `begin` is done: that share of the time since was theirs [us].
  double end(double begin) {
    const std::lock_guard lock(mutex_);
    advance();
    --working_;
    return shared_ - begin;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void advance() {
    const Clock::time_point now = Clock::now();
    if (working_ > 0)
      shared_ += std::chrono::duration<double, std::micro>(now - last_).count() / working_;
    last_ = now;
  }

  std::mutex mutex_;
  Clock::time_point last_;
  double shared_ = 0;  ///< what somebody who always worked would be charged [us]
  int working_ = 0;
};

}  // namespace posevote::graph::detail
