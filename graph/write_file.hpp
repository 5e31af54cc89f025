// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace posevote::graph {

/// Writes a file anew: under its name there is what was there before, or all of `bytes`, whatever
/// happens between. What is no plain file (a pipe, /dev/stdout) is written as it is. Throws
/// std::runtime_error "FILE: cannot be written: cause".
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The same, and on the disk when it returns: what is under the name outlasts a loss of power.
void write_durably(const std::filesystem::path& file, std::string_view bytes);

/// Takes away what processes that were killed have left of files in a folder, where nobody else is
/// writing.
void remove_unfinished(const std::filesystem::path& folder);

}  // namespace posevote::graph
