// SPDX-License-Identifier: BSD-3-Clause
// Runs the built `posevote` as a user would.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace posevote::test {

struct CommandResult {
  int status = -1;
  std::string output;  ///< standard output and standard error
};

/// `arguments` as typed in a shell. The cache of libraries is `folder`/cache.
inline CommandResult run_posevote(const TemporaryFolder& folder, const std::string& arguments,
                                  const std::string& program = POSEVOTE_BINARY) {
  const std::filesystem::path log = folder / "log.txt";
  const std::string command = "XDG_CACHE_HOME='" + (folder / "cache").string() + "' '" + program +
                              "' " + arguments + " > '" + log.string() + "' 2>&1";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(log)};
}

inline nlohmann::json read_json(const std::filesystem::path& file) {
  return nlohmann::json::parse(read_text(file));
}

}  // namespace posevote::test
