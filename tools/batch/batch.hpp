// SPDX-License-Identifier: BSD-3-Clause
// Runs in several folders as the parts of one batch: `posevote status` and `posevote merge`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace posevote {

/// Options of `status`.
struct StatusCommand {
  std::vector<std::string> out;
  bool json = false;
};
int status_command(const StatusCommand& command);

/// Options of `merge`.
struct MergeCommand {
  std::vector<std::string> parts;
  std::string out;
  bool overwrite = false, json = false;
};
int merge_command(const MergeCommand& command);

/// How far a run is.
struct RunStatus {
  std::filesystem::path out;
  std::size_t done = 0, failed = 0;  ///< frames
  std::size_t left = 0;              ///< of the shards that were started
  double rate = 0;                   ///< frames a second since its last start; 0: none yet
  bool is_running = false;           ///< a process holds the folder
  std::string host;                  ///< of its last start
  int process = 0;                   ///< that holds the folder, or that started last
};

/// Throws std::invalid_argument where the folder holds no run, std::runtime_error where its manifest
/// is damaged.
RunStatus read_status(const std::filesystem::path& out);

/// Writes to `out` what one run over all scans would have written, from runs over its shards, and
/// returns its frames. Throws std::invalid_argument that names the folder and the frame where a part
/// is of another run, is still written or is damaged, or where a frame is missing or in two parts;
/// nothing is written then.
RunStatus merge(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& out,
                bool overwrite);

}  // namespace posevote
