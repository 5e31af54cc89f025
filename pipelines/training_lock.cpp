// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/training_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace posevote {
namespace {

/// Again where a signal came between.
bool lock(int descriptor, int how) {
  while (flock(descriptor, how) != 0)
    if (errno != EINTR) return false;
  return true;
}

bool is_there(int descriptor, const std::filesystem::path& file) {
  struct stat open {};
  struct stat named {};
  return fstat(descriptor, &open) == 0 && stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

TrainingLock::TrainingLock(const std::filesystem::path& library) : file_(library) {
  file_ += ".lock";
  std::error_code ignored;
  std::filesystem::create_directories(file_.parent_path(), ignored);
  while (!take()) {
  }
}

bool TrainingLock::take() {
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return true;
  if (!lock(descriptor_, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK) {
    waited_ = true;
    lock(descriptor_, LOCK_EX);
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
