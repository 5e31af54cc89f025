// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/training_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace posevote {
namespace {

/// False where another process has it.
bool lock(int descriptor) {
  while (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    if (errno != EINTR) return errno != EWOULDBLOCK;
  return true;
}

bool is_there(int descriptor, const std::filesystem::path& file) {
  struct stat open {};
  struct stat named {};
  return fstat(descriptor, &open) == 0 && stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

TrainingLock::TrainingLock(const std::filesystem::path& library, const graph::Activity* activity)
    : file_(library) {
  file_ += ".lock";
  std::error_code ignored;
  std::filesystem::create_directories(file_.parent_path(), ignored);
  while (!take(activity)) {
  }
}

bool TrainingLock::take(const graph::Activity* activity) {
  constexpr std::chrono::milliseconds kPatience(20);
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return true;
  while (!lock(descriptor_)) {
    waited_ = true;
    if (activity && activity->is_cancelled()) {
      close(descriptor_);
      throw graph::Cancelled();
    }
    std::this_thread::sleep_for(kPatience);
  }
  if (is_there(descriptor_, file_)) return true;
  close(descriptor_);
  return false;
}

TrainingLock::~TrainingLock() {
  if (descriptor_ < 0) return;
  unlink(file_.c_str());
  close(descriptor_);
}

}  // namespace posevote
