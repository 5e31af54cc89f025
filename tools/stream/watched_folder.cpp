// SPDX-License-Identifier: BSD-3-Clause
#include "tools/stream/watched_folder.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "nodes/formats/format.hpp"
#include "nodes/layouts/files.hpp"

namespace posevote::stream {
namespace {

namespace fs = std::filesystem;

bool is_scan(const fs::path& file) {
  return !file.filename().string().starts_with('.') &&
         formats::has_ending(file, formats::Wanted::kAny);
}

/// Whether somebody has the file open to write: then a read lease is refused. Where the file system
/// knows no leases, nobody can tell.
bool is_being_written(const fs::path& file) {
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return false;  // for the frame to fail on
  const bool refused = ::fcntl(opened, F_SETLEASE, F_RDLCK) != 0 && errno == EAGAIN;
  ::close(opened);  // and the lease is gone
  return refused;
}

}  // namespace

WatchedFolder::WatchedFolder(fs::path folder) : folder_(std::move(folder)) {
  const auto fail = [this] {
    throw std::runtime_error(folder_.string() +
                             ": cannot be watched: " + std::generic_category().message(errno));
  };
  events_ = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  if (events_ < 0) fail();
  const std::uint32_t mask =
      IN_CLOSE_WRITE | IN_MOVED_TO | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;
  if (::inotify_add_watch(events_, folder_.c_str(), mask) < 0) {
    ::close(events_);
    fail();
  }
  wake_ = ::eventfd(0, EFD_CLOEXEC);
  list();
  thread_ = std::thread([this] { watch(); });
}

WatchedFolder::~WatchedFolder() {
  const std::uint64_t one = 1;
  while (::write(wake_, &one, sizeof one) < 0 && errno == EINTR) {
  }
  thread_.join();
  ::close(wake_);
  ::close(events_);
}

std::vector<Arrival> WatchedFolder::take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [this] { return !arrived_.empty() || !ended_.empty(); });
  return std::exchange(arrived_, {});
}

std::string WatchedFolder::ended() const {
  const std::lock_guard lock(mutex_);
  return arrived_.empty() ? ended_ : "";
}

void WatchedFolder::watch() {
  for (;;) {
    pollfd ready[2] = {{events_, POLLIN, 0}, {wake_, POLLIN, 0}};
    if (::poll(ready, 2, -1) < 0 && errno != EINTR) return end(std::strerror(errno));
    if (ready[1].revents != 0) return;
    read_events();
  }
}

void WatchedFolder::read_events() {
  alignas(inotify_event) char buffer[16384];
  for (;;) {
    const ssize_t size = ::read(events_, buffer, sizeof buffer);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return;
    for (ssize_t at = 0; at < size;) {
      inotify_event event;
      std::memcpy(&event, buffer + at, sizeof event);
      hear(event.mask, event.len > 0 ? buffer + at + sizeof event : "");
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
  }
}

void WatchedFolder::hear(std::uint32_t mask, const std::string& name) {
  if ((mask & IN_Q_OVERFLOW) != 0) return list();
  if ((mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED)) != 0)
    return end(folder_.string() + " is not there any more");
  if (name == kStopFile) return end("stopped by " + (folder_ / name).string());
  const fs::path file = folder_ / name;
  if ((mask & IN_ISDIR) != 0 || !is_scan(file)) return;
  std::error_code none;
  const auto known = listed_.find(file);  // its event may come after it was listed
  if (known != listed_.end() && known->second == fs::last_write_time(file, none)) return;
  add(file);
}

/// What is there and was not listed as it is.
void WatchedFolder::list() {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error))
    if (is_scan(entry->path()) && !is_being_written(entry->path())) files.push_back(entry->path());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return layouts::in_natural_order(a.string(), b.string());
  });
  for (const fs::path& file : files) {
    const Time written = fs::last_write_time(file, error);
    const auto known = listed_.find(file);
    if (known != listed_.end() && known->second == written) continue;
    listed_[file] = written;
    add(file);
  }
  if (fs::exists(folder_ / kStopFile, error)) end("stopped by " + (folder_ / kStopFile).string());
}

void WatchedFolder::add(const fs::path& file) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(arrived_, [&](const Arrival& one) { return one.file == file; });
    arrived_.push_back({file, std::chrono::steady_clock::now()});
  }
  changed_.notify_one();
}

void WatchedFolder::end(const std::string& why) {
  {
    const std::lock_guard lock(mutex_);
    if (ended_.empty()) ended_ = why;
  }
  changed_.notify_one();
}

}  // namespace posevote::stream
