// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "tests/support/command.hpp"

namespace posevote::test {

/// In a shell in `folder`, with a cache of its own.
inline CommandResult run_in(const TemporaryFolder& folder, const std::string& command) {
  const std::filesystem::path log = folder / "log.txt";
  const int status =
      std::system(("cd '" + folder.path().string() + "' && export XDG_CACHE_HOME=$PWD/cache && (" +
                   command + ") > '" + log.string() + "' 2>&1")
                      .c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(log)};
}

inline bool contains(const CommandResult& result, const std::string& text) {
  UNSCOPED_INFO(result.output);
  return result.output.find(text) != std::string::npos;
}

}  // namespace posevote::test
