// SPDX-License-Identifier: BSD-3-Clause
// How many frames are in flight: as many as there are tokens, and as have room in memory.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace posevote::graph::detail {

class Admission {
 public:
  /// `memory`: [bytes] of all frames in flight; 0: any.
  Admission(std::size_t tokens, std::size_t memory) : tokens_(tokens), memory_(memory) {}

  /// Waits until another frame may be in flight.
  void await_token() {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [this] { return count_ < tokens_; });
  }
  /// Waits until there is room for the frame, or no other is in flight.
  void enter(std::size_t bytes) {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [this, bytes] {
      return count_ == 0 || memory_ == 0 || (used_ <= memory_ && bytes <= memory_ - used_);
    });
    ++count_;
    used_ += bytes;
  }
  void leave(std::size_t bytes) {
    {
      const std::lock_guard lock(mutex_);
      --count_;
      used_ -= bytes;
    }
    left_.notify_one();
  }

 private:
  const std::size_t tokens_, memory_;
  std::mutex mutex_;
  std::condition_variable left_;
  std::size_t count_ = 0, used_ = 0;
};

}  // namespace posevote::graph::detail
