// SPDX-License-Identifier: BSD-3-Clause
// What lies in a folder. What may not be looked at is not there.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

namespace posevote {

inline bool is_file(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

/// In the order of their names.
inline std::vector<std::filesystem::path> list_folder(const std::filesystem::path& folder) {
  std::error_code none;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace posevote
