// SPDX-License-Identifier: BSD-3-Clause
// One run at a time writes into a folder.
#pragma once

#include <filesystem>
#include <optional>

namespace posevote {

/// Makes the folder, and holds it until it goes; a crash lets go, too. Throws std::runtime_error
/// where another process holds it, or it cannot be made. Where the file system knows no locks,
/// nothing is held.
class RunLock {
 public:
  explicit RunLock(const std::filesystem::path& out);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  int folder_ = -1;
};

/// The process that holds a folder; 0 where it is not one of this machine. Nothing where nobody holds
/// it.
std::optional<int> lock_holder(const std::filesystem::path& out);

}  // namespace posevote
