// SPDX-License-Identifier: BSD-3-Clause
// Bodies on a table. World frame: the table is the plane z = 0, z points up [m].
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "tools/simulate/random.hpp"

namespace posevote {

/// One thing in a scene. `mesh` is in the body's own frame [m].
struct Body {
  std::shared_ptr<const Cloud> mesh;
  int obj_id = 0;  ///< 0: table or clutter, which nobody looks for
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
};

/// A square at z = 0 around the origin.
Body make_table(double side);

/// Poses the bodies one after another, within `radius` of the origin: each in a random orientation
/// straight down until it touches the table or a body before it; of eight tries the one that comes
/// to lie lowest. Bodies stay where they touch (nothing topples), a few mm above others where their
/// sides are steep, and never reach into each other.
void drop_bodies(std::vector<Body>& bodies, double radius, Random& random);

}  // namespace posevote
