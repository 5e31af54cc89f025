// SPDX-License-Identifier: BSD-3-Clause
// What explains a scan, drawn over it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/explain/explain.hpp"

namespace posevote::explain {

/// "candidates": each best candidate with its confidence, and each true pose that was missed, in
/// colours of their own. "matches": the features that are matched to the objects of the explanation,
/// green those that vote for a best candidate. "votes": where matches put the objects' centres, from
/// blue to red by density.
const std::vector<std::string>& drawn();

/// One of these over the scan in grey. Throws std::runtime_error naming the file if it cannot be
/// written.
void draw(const Explanation& explanation, const std::string& what,
          const std::filesystem::path& png);

}  // namespace posevote::explain
