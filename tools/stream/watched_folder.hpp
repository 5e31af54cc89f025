// SPDX-License-Identifier: BSD-3-Clause
// A folder into which somebody writes scans, watched by inotify. A file counts when its writer has
// closed it or moved it there, never half-written.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace posevote::stream {

/// A file of this name in the folder says that no more will come.
inline const std::string kStopFile = "stop";

/// A scan that is there to be read.
struct Arrival {
  std::filesystem::path file;
  std::chrono::steady_clock::time_point when;
};

class WatchedFolder {
 public:
  /// What is there already, and complete, has arrived, in the order of its names. Throws
  /// std::runtime_error where the folder cannot be watched.
  explicit WatchedFolder(std::filesystem::path folder);
  ~WatchedFolder();
  WatchedFolder(const WatchedFolder&) = delete;
  WatchedFolder& operator=(const WatchedFolder&) = delete;

  /// What has arrived since the last call, the oldest first. Waits for it, but not longer than
  /// `patience`. A file that was written anew before anybody took it is one.
  std::vector<Arrival> take(std::chrono::milliseconds patience);
  /// Why no more will come; "" while more may.
  std::string ended() const;

 private:
  using Time = std::filesystem::file_time_type;

  void watch();
  void read_events();
  void hear(std::uint32_t mask, const std::string& name);
  void list();
  void add(const std::filesystem::path& file);
  void end(const std::string& why);

  const std::filesystem::path folder_;
  int events_ = -1;                               ///< of inotify
  int wake_ = -1;                                 ///< by the destructor
  std::map<std::filesystem::path, Time> listed_;  ///< as they were when they were listed
  mutable std::mutex mutex_;                      ///< of what follows
  std::condition_variable changed_;
  std::vector<Arrival> arrived_;
  std::string ended_;
  std::thread thread_;
};

}  // namespace posevote::stream
