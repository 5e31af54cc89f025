// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace posevote::graph {

/// ", did you mean 'x'?" of the nearest of `known`, or "" if none is near.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known);

}  // namespace posevote::graph
