// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// Rows of the scan's points that nothing explained yet, nearer than `reach` to a place [m].
std::vector<Eigen::Index> rows_near(const Sought& sought, const Eigen::Vector3d& place,
                                    double reach);

}  // namespace posevote::poses
