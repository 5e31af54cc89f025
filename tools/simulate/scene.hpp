// SPDX-License-Identifier: BSD-3-Clause
// Bodies and what they lie on. World frame: the ground is the plane z = 0, z points up [m].
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "tools/simulate/paint.hpp"
#include "tools/simulate/random.hpp"

namespace posevote {

/// One thing in a scene. `mesh` is in the body's own frame [m], closed unless it is the ground.
struct Body {
  std::shared_ptr<const Mesh> mesh;
  int obj_id = 0;  ///< 0: ground or clutter, which nobody looks for
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  std::shared_ptr<const Paint> paint{};  ///< null: grey
  /// From its own frame to that of the thing it was stretched from, which the paint is of.
  Eigen::Affine3d T_paint_body = Eigen::Affine3d::Identity();
};

/// A square at z = 0 around the origin.
Body make_table(double side);

/// A square open box around the origin that stands on z = 0: floor, and walls of 0.1 m. `radius`:
/// half its inner side.
Body make_bin(double radius);

}  // namespace posevote
