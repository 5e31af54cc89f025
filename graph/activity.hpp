// SPDX-License-Identifier: BSD-3-Clause
// What the nodes of a run are at, for whoever shows that it moves.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <list>
#include <mutex>
#include <optional>
#include <string>

namespace posevote::graph {

/// What comes out of a run that was cancelled.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// The calls of nodes that are running now. May be used by several threads at a time.
class Activity {
 public:
  /// Once `cancelled` is true no node begins, nor one that runs once for each object with another
  /// object, and the run throws Cancelled. Null: it never is.
  explicit Activity(const std::atomic<bool>* cancelled = nullptr) : cancelled_(cancelled) {}

  struct Work {
    std::string node;
    std::string frame;        ///< its name; may be empty
    double seconds = 0;       ///< since the call began
    std::size_t done = 0;     ///< objects that the node has finished
    std::size_t objects = 0;  ///< of so many; 0 where it does not run once for each
  };

  /// Counts as running while it lives; does nothing where `activity` is null.
  class Call {
   public:
    Call(Activity* activity, const std::string& node, const std::string& frame);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    void begin_objects(std::size_t count);
    void end_object();
    bool is_cancelled() const { return activity_ && activity_->is_cancelled(); }

   private:
    friend class Activity;
    Activity* activity_;
    Work work_;
    std::chrono::steady_clock::time_point begin_;
    std::list<const Call*>::iterator place_;
  };

  bool is_cancelled() const { return cancelled_ && *cancelled_; }
  /// The call that has been running longest.
  std::optional<Work> longest() const;

 private:
  const std::atomic<bool>* cancelled_;
  mutable std::mutex mutex_;
  std::list<const Call*> running_;  ///< in the order in which they began
};

}  // namespace posevote::graph
