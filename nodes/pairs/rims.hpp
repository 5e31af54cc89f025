// SPDX-License-Identifier: BSD-3-Clause
// Where the faces of a surface end: at a crease to another face, at a drop, at a border. A flat face
// has no shape but that of its rim.
#pragma once

#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/pairs/local_frame.hpp"

namespace posevote::pairs {

/// x resolution of a cloud: the ground on which its rims are told.
inline constexpr float kRimRadius = 4;

/// A point at the end of a face. Unlike an oriented point it leaves nothing of a pose open.
struct Rim {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;     ///< of the face, unit
  Eigen::Vector3f direction;  ///< unit, along the face to where it is no more
};

/// The ends of a cloud's faces, in the order of its points: where the face lies to one side, the
/// mean of the neighbours within `radius` [m] that belong to it is off by as much as that of half a
/// disc. Points without a normal are none. O(points x neighbours).
std::vector<Rim> find_rims(const Cloud& cloud, float radius);

/// For each cube of edge `edge` [m] one for each face and direction, 30 deg apart.
std::vector<Rim> thin_rims(const std::vector<Rim>& rims, float edge);

/// For pairs, their points with the directions in which the faces end for normals.
Cloud cloud_of(const std::vector<Rim>& rims);

/// The same as frames, of which u is the normal of the face.
/// Two ends of one straight edge then lie in one plane, and are as little a pair as two points of a
/// plane (pair_key.hpp).
std::vector<LocalFrame> frames_of(const std::vector<Rim>& rims);

}  // namespace posevote::pairs
