// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// The rows of finite points in the order of Morton's curve (1966) through cubes of that edge [m],
/// of which no row stands alone far from the next: those that follow one another lie together, on a
/// surface as in space. Where the points span more than two million cubes along an axis, cubes are
/// larger.
std::vector<std::uint32_t> rows_along_curve(const PointMatrix& points, float edge);

}  // namespace posevote::geometry
