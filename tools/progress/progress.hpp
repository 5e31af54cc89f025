// SPDX-License-Identifier: BSD-3-Clause
// What a long command shows of itself: on a terminal one live line, in a log a plain line whenever
// nothing has been written for a while, which grows from two seconds to a minute.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "graph/activity.hpp"

namespace posevote {

struct Task {
  std::string what;       ///< what is counted ("frames"), or what is done ("training 4 models")
  std::size_t total = 0;  ///< 0: nothing is counted
  const graph::Activity* activity = nullptr;  ///< what takes long is named, unless null
  bool shown = true;
  const std::atomic<bool>* interrupted = nullptr;  ///< by Ctrl-C; of a task that counts
  double patience = 2;  ///< [s] without a sign of life, before the first line in a log
};

/// A task at one moment.
struct TaskState {
  std::size_t done = 0;
  double seconds = 0;  ///< since it began
  std::string note{};
  std::optional<graph::Activity::Work> work{};
  double waiting = 0;  ///< seconds since the last one was done
};

/// "[12/200] 3.1 frames/s, 1 min 01 s left, 31 found, 0 failed; match_features at rs12 for 3 s". The
/// rate is the mean until the last one that is done; a call of a node is named after two seconds.
std::string to_text(const Task& task, const TaskState& state);

/// Shows a task while it lives. Its functions may be called by several threads at a time.
class Progress {
 public:
  explicit Progress(Task task);
  /// Takes the live line away.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::size_t count = 1);
  /// What else to show: "31 found, 0 failed".
  void note(std::string text);

 private:
  void show(std::unique_lock<std::mutex>& lock);
  TaskState state() const;
  double seconds() const;

  const Task task_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::size_t done_ = 0;
  double advanced_ = 0;  ///< [s] after the beginning
  std::string note_;
  std::thread thread_;
};

}  // namespace posevote
