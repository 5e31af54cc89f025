// SPDX-License-Identifier: BSD-3-Clause
// What `run` may be told of how scans come, and what they may take. Runs of other commands take what
// is there.
#pragma once

#include "tools/commands.hpp"

namespace posevote {

struct StreamOptions {
  bool follow = false, real_time = false;
  std::uint64_t memory = 0;  ///< of frames in flight [bytes]; 0: half of the machine's
};

int run_command(const RunCommand& command, const StreamOptions& options,
                const std::atomic<bool>& interrupted);

}  // namespace posevote
