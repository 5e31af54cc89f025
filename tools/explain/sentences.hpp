// SPDX-License-Identifier: BSD-3-Clause
// An explanation in words.
#pragma once

#include <string>
#include <vector>

#include "tools/explain/explain.hpp"

namespace posevote::explain {

/// What the scan is like: its noise, spacing and resolution, what the nodes warned of.
std::vector<std::string> scan_sentences(const graph::Figures& figures,
                                        const std::vector<std::string>& warnings);

/// The cause first, then the figures that it rests on; no sentence for what tells nothing.
std::vector<std::string> sentences(const Explained& one, const Case& of);

/// All of it as the command prints it.
std::string to_text(const Explanation& explanation);

}  // namespace posevote::explain
