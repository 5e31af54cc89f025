// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "nodes/data/files.hpp"

namespace posevote::formats {

/// library::hash_files of a scan's file, of the one beside it that says where the sensor stood, and of
/// those that hold its colours. "" where the scan is in memory. Throws std::runtime_error naming a
/// file that cannot be read.
std::string hash_scan(const SceneFile& scan);
/// The same, but "" where a file cannot be read: nobody knows what the scan holds.
std::string hash_or_unknown(const SceneFile& scan);

}  // namespace posevote::formats
