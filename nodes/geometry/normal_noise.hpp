// SPDX-License-Identifier: BSD-3-Clause
// How far a sensor's noise tilts the normals of a scan, measured from the scan itself. White noise
// averages out over a neighbourhood; that of depth cameras does not, since their pixels share
// windows of correlation and steps of disparity: normals stay tilted by some degrees over a
// centimetre and more, however small the noise of single points is. So both are measured.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Standard deviation of the tilt of normals about either axis [rad], of planes through the points
/// `rows` in cubes of edge `width` [m]: how far the normal of a cube lies off the mean of those of
/// its two opposite neighbours. Taken where the surface is flattest, the lowest quarter, so that
/// curvature and edges count little. Nothing where fewer than twenty cubes have such neighbours.
std::optional<float> normal_noise(const PointMatrix& points, const std::vector<std::uint32_t>& rows,
                                  const Eigen::Vector3f& viewpoint, float width);

}  // namespace posevote::geometry
