// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace posevote::graph {

/// The cause that the C library gives in an errno; a guess where it gives none.
std::string cause_of(int error);

/// Writes a file anew: under its name there is what was there before, or all of `bytes`, whatever
/// happens between. What is no plain file (a pipe, /dev/stdout) is written as it is. Throws
/// std::runtime_error "FILE: cannot be written: cause".
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The same, and on the disk when it returns: what is under the name outlasts a loss of power.
void write_durably(const std::filesystem::path& file, std::string_view bytes);

/// Puts on the disk what has been written to a file, or which names a folder has. Throws
/// std::runtime_error "FILE: cannot be written: cause"; a file system that knows no such thing is
/// none.
void sync_file(const std::filesystem::path& file);

}  // namespace posevote::graph
