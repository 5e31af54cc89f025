// SPDX-License-Identifier: BSD-3-Clause
// The memory of frames in flight: what a scan is expected to take, told from its file's head.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>

#include "nodes/data/files.hpp"

namespace posevote::stream {

class ScanSizes {
 public:
  /// [bytes], at the worst moment of its way; 0 where nobody can tell. Opens the file, but does not
  /// read it. In a file of many images the first one stands for all of its topic: to look at each
  /// would be to read the whole file.
  std::size_t expected(const SceneFile& file);

 private:
  std::map<std::filesystem::path, std::size_t> of_topics_;
};

/// [bytes] for all frames in flight: as asked, else half of the machine's.
std::size_t memory_limit(std::uint64_t asked);

/// How many points or pixels a scan may have that takes no more by itself.
int most_points(std::size_t memory);

}  // namespace posevote::stream
