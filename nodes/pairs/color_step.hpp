// SPDX-License-Identifier: BSD-3-Clause
// How colour changes from one end of a pair of points to the other, in one byte: what exposure and
// white balance do to both ends alike does not count, and shading little.
#pragma once

#include <array>
#include <cstdint>

#include "nodes/data/cloud.hpp"

namespace posevote::pairs {

/// Of the pair from one colour to another, both in CIELAB.
std::uint8_t color_step(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

/// For each step that a model's pair may have: 1 if it is like one of a scan, else 0, so that counting
/// needs no branch.
using LikeSteps = std::array<std::uint8_t, 256>;
const LikeSteps& like_steps(std::uint8_t step);

}  // namespace posevote::pairs
