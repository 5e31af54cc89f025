// SPDX-License-Identifier: BSD-3-Clause
// Bodies that were found in a scan. Where one is no other can be: of a wrong pose what is inside of
// its neighbour seems but hidden, which speaks neither for it nor against it.
#pragma once

#include <Eigen/Geometry>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/near_surface.hpp"

namespace posevote::poses {

class Solid {
 public:
  /// Keeps a reference to the model. `depth`: how far below the surface inside begins [m].
  Solid(const Cloud& model, const Eigen::Isometry3d& T_scene_model, float depth);

  /// The share of the other's points that lie inside; of some 500, evenly chosen. A sheet that is
  /// seen from both sides has no inside.
  double share_inside(const Cloud& other, const Eigen::Isometry3d& T_scene_other) const;

 private:
  bool has_inside(const Eigen::Vector3f& point) const;
  Eigen::Index nearest(const Eigen::Vector3f& point) const;
  bool is_sheet(Eigen::Index row) const;

  const Cloud& model_;
  Eigen::Isometry3d T_model_scene_;
  float depth_;
  Eigen::AlignedBox3f box_;
  geometry::SurfaceIndex index_;
};

}  // namespace posevote::poses
