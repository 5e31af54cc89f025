// SPDX-License-Identifier: BSD-3-Clause
// How many frames are in flight: as many as there are tokens.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace posevote::graph::detail {

class Admission {
 public:
  explicit Admission(std::size_t tokens) : tokens_(tokens) {}

  /// Waits until another frame may be in flight.
  void await_token() {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [this] { return count_ < tokens_; });
  }
  void enter() {
    const std::lock_guard lock(mutex_);
    ++count_;
  }
  void leave() {
    {
      const std::lock_guard lock(mutex_);
      --count_;
    }
    left_.notify_one();
  }

 private:
  const std::size_t tokens_;
  std::mutex mutex_;
  std::condition_variable left_;
  std::size_t count_ = 0;
};

}  // namespace posevote::graph::detail
