// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "tools/explain/explain.hpp"

namespace posevote::explain {

/// Everything, lengths in m, angles in rad.
nlohmann::ordered_json to_json(const Explanation& explanation);

nlohmann::ordered_json to_json(const Verdict& verdict);

}  // namespace posevote::explain
