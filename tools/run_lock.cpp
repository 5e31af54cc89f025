// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

namespace posevote {
namespace {

int open_folder(const std::filesystem::path& folder) {
  return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

/// False where another process has it. Somebody who looks whether it is held (lock_holder) has it
/// for a moment, too.
bool take(int folder) {
  constexpr int kTries = 5;
  for (int i = 0; i < kTries; ++i) {
    if (flock(folder, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
  }
  return false;
}

/// "1: FLOCK  ADVISORY  WRITE 4711 08:02:1234 0 EOF" of the folder.
int process_with_lock(int folder) {
  struct stat status {};
  fstat(folder, &status);
  const std::string inode = ":" + std::to_string(status.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string text; std::getline(locks, text);) {
    std::istringstream words(text);
    std::string number, type, mode, access, place;
    int process = 0;
    words >> number >> type >> mode >> access >> process >> place;
    if (type == "FLOCK" && access == "WRITE" && place.ends_with(inode)) return process;
  }
  return 0;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& out) {
  std::error_code failed;
  std::filesystem::create_directories(out, failed);
  if (failed)
    throw std::runtime_error(out.string() + ": cannot be made: " + failed.message() +
                             "; choose another --out");
  folder_ = open_folder(out);
  if (folder_ < 0 || take(folder_)) return;
  close(folder_);
  throw std::runtime_error(out.string() +
                           ": another run is writing there; wait for it, or choose another --out "
                           "(shards that run at once need one each)");
}

RunLock::~RunLock() {
  if (folder_ >= 0) close(folder_);
}

std::optional<int> lock_holder(const std::filesystem::path& out) {
  const int folder = open_folder(out);
  if (folder < 0) return std::nullopt;
  std::optional<int> holder;
  if (flock(folder, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    holder = process_with_lock(folder);
  close(folder);
  return holder;
}

}  // namespace posevote
