// SPDX-License-Identifier: BSD-3-Clause
// The memory of frames in flight: what a scan is expected to take, told from its file's head, and how
// many may so be on their way at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipelines/inputs.hpp"

namespace posevote::stream {

/// [bytes], at the worst moment of its way; 0 where nobody can tell. Opens the file, but does not
/// read it; of a file of many images it reads the one.
std::size_t expected_bytes(const SceneFile& file);

/// [bytes] for all frames in flight: as asked, else half of the machine's.
std::size_t memory_limit(std::uint64_t asked);

/// How many of the scans may be in flight: `tokens`, or as many of the largest as there is memory
/// for; one at least.
std::size_t tokens_within(std::size_t memory, std::size_t tokens,
                          const std::vector<SceneEntry>& scans);

/// How many points or pixels a scan may have that takes no more by itself.
int most_points(std::size_t memory);

}  // namespace posevote::stream
