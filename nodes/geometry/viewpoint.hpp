// SPDX-License-Identifier: BSD-3-Clause
// Whether a place can be where a scan's sensor stood. A scan shows what faces its sensor: normals
// that came with it point there, and the points lie before it, not around it.
#pragma once

#include <optional>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Share of the points' normals that point to the side of their surface on which `place` lies
/// (scan's frame [m]); nothing where less than half of the points have a normal.
std::optional<double> share_facing(const Mesh& scan, const Eigen::Vector3f& place);

/// Whether the scan, strays aside, lies before `place` and not around it. A scanner that turns
/// round itself may well stand within its scan; nothing but its user can tell.
bool lies_before(const PointMatrix& points, const Eigen::Vector3f& place);

/// Share of the points that others hide from `place`, whichever way the normals point; 1 where the
/// scan does not lie before it. From where the sensor stood it sees all but some at the edges.
double share_hidden(const Mesh& scan, const Eigen::Vector3f& place);

/// The middle of the places that as many of the normals as possible point to [m]: the direction to
/// the sensor is right within some 10 deg, the distance within a factor of 2.
Eigen::Vector3f estimate_viewpoint(const Mesh& scan);

}  // namespace posevote::geometry
