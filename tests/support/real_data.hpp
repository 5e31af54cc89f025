// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>

namespace posevote::test {

/// Where real scans may be: $POSEVOTE_DATA, or beside the project. Tests skip where they are not.
inline std::filesystem::path real_data() {
  if (const char* given = std::getenv("POSEVOTE_DATA")) return given;
  return std::filesystem::path(POSEVOTE_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace posevote::test
