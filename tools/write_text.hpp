// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace posevote {

/// Writes a file anew. Throws std::runtime_error naming it and the cause if it cannot be written.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace posevote
