// SPDX-License-Identifier: BSD-3-Clause
// A trained model library as one file, so that models are prepared and described once.
//
// Layout, little-endian: magic, format version, then key, XXH3-128 checksum of the payload (32
// hexadecimal digits) and payload, each after its length. The index is not stored but built anew:
// that takes some 10 ms for 11 000 descriptors, and a tree of FLANN read from a file cannot be
// verified.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "nodes/data/model.hpp"

namespace posevote::library {

/// Writes a file of its own beside `path` and renames it, so that readers and other writers always
/// see a whole file; a symbolic link stays one. Throws std::runtime_error naming the file if it
/// cannot be written, or if a device or a folder is there.
void save_library(const ModelLibrary& library, const std::filesystem::path& path,
                  const std::string& key);

/// Reads what save_library wrote under the same key. A file that is missing, damaged, truncated, of
/// another kind, version or key gives nothing, and `why_not` says why. Lengths in the file are
/// checked against its size before anything is allocated.
std::optional<ModelLibrary> load_library(const std::filesystem::path& path, const std::string& key,
                                         std::string& why_not);

/// checksum (content_hash.hpp) of all that a library holds.
std::string hash_library(const ModelLibrary& library);

}  // namespace posevote::library
