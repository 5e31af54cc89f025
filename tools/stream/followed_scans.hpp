// SPDX-License-Identifier: BSD-3-Clause
// The scans of `run --follow`, as they arrive in a folder.
#pragma once

#include <atomic>
#include <deque>
#include <set>
#include <string>

#include "tools/stream/scans.hpp"
#include "tools/stream/watched_folder.hpp"

namespace posevote::stream {

class FollowedScans : public Scans {
 public:
  /// `folder`: of scans, or with depth images in depth/ and their camera beside that. `real_time`:
  /// of those that wait, the newest alone is taken. `interrupted`: ends the wait. Throws
  /// std::runtime_error where the folder cannot be watched, or holds a recording of another kind.
  FollowedScans(const std::filesystem::path& folder, bool real_time,
                const std::atomic<bool>& interrupted);

  std::optional<TakenScan> next() override;

 private:
  bool wait();
  SceneEntry entry_of(const std::filesystem::path& file);

  WatchedFolder folder_;
  const bool real_time_;
  const std::atomic<bool>& interrupted_;
  std::deque<Arrival> waiting_;
  std::set<std::string> names_;  ///< of frames
  std::size_t taken_ = 0;
};

}  // namespace posevote::stream
