// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tools/explain/explain.hpp"

namespace posevote::explain {

/// The scan in grey, and over it each best candidate with its confidence, and each true pose that
/// was missed, in colours of their own. Throws std::runtime_error naming the file if it cannot be
/// written.
void draw(const Explanation& explanation, const Run& run, const std::filesystem::path& png);

}  // namespace posevote::explain
