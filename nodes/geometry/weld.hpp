// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// For each point the number of the first one in exactly the same place. O(n log n).
std::vector<std::uint32_t> weld(const PointMatrix& points);

}  // namespace posevote::geometry
