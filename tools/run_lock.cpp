// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace posevote {

RunLock::RunLock(const std::filesystem::path& out) {
  std::filesystem::create_directories(out);
  folder_ = open(out.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_ < 0 || flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(folder_);
  throw std::runtime_error(out.string() +
                           ": another run is writing there; wait for it, or choose another --out "
                           "(shards that run at once need one each)");
}

RunLock::~RunLock() {
  if (folder_ >= 0) close(folder_);
}

}  // namespace posevote
