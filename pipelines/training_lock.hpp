// SPDX-License-Identifier: BSD-3-Clause
// Of several processes that want the same library one makes it, and the others wait for it: shards of a
// batch that start at once.
#pragma once

#include <filesystem>

#include "graph/activity.hpp"

namespace posevote {

class TrainingLock {
 public:
  /// Waits until no other process has the lock of that library's file. Where its folder cannot be
  /// written, or the file system has no locks, nobody waits. Throws graph::Cancelled by `activity`,
  /// unless null, while it waits.
  TrainingLock(const std::filesystem::path& library, const graph::Activity* activity);
  ~TrainingLock();
  TrainingLock(const TrainingLock&) = delete;
  TrainingLock& operator=(const TrainingLock&) = delete;

  /// Whether another process had it: the library may be there now.
  bool waited() const { return waited_; }

 private:
  /// False where somebody else takes the file away as this one gets it.
  bool take(const graph::Activity* activity);

  std::filesystem::path file_;
  int descriptor_ = -1;
  bool waited_ = false;
};

}  // namespace posevote
