// SPDX-License-Identifier: BSD-3-Clause
// Meshes as CAD programs write them: exact, closed, wound outward, of as few triangles as the shape
// needs, however long and thin.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <tuple>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/formats/raw_mesh.hpp"

namespace posevote::simulate {

using Outline =
    std::vector<Eigen::Vector2d>;  ///< counter-clockwise; the last corner joins the first
using Ring = std::vector<Eigen::Vector3d>;

/// A regular polygon; its first corner lies at `phase` [rad] from x.
Outline circle(int corners, double radius, const Eigen::Vector2d& center = {0, 0},
               double phase = 0);
/// A rectangle around the origin.
Outline rectangle(double width, double height);
/// The same with its corners cut round, `steps` edges each.
Outline rounded_rectangle(double width, double height, double radius, int steps);

/// Adds face to face. Corners at the same place are one vertex; where faces meet along a part of an
/// edge only, the mesh is not closed.
class CadMesh {
 public:
  /// Where the outlines lie: in the x-y plane of this frame, z out of it.
  void place(const Eigen::Isometry3d& T_mesh_outline) { frame_ = T_mesh_outline; }

  /// The sides of a prism from z0 up to z1, seen from outside.
  void wall(const Outline& outline, double z0, double z1) { wall(outline, z0, z1, false); }
  /// The same of a hole, seen from inside.
  void bore(const Outline& outline, double z0, double z1) { wall(outline, z0, z1, true); }
  /// A flat face at height z with holes in it, seen from above, or from below.
  void top(const Outline& outline, double z, const std::vector<Outline>& holes = {});
  void bottom(const Outline& outline, double z, const std::vector<Outline>& holes = {});
  /// A solid prism with holes through it.
  void prism(const Outline& outline, double z0, double z1, const std::vector<Outline>& holes = {});
  /// A solid of revolution about z, `corners` around, from profile points (radius, z) in order from
  /// below: it is seen from the side that lies right of the profile's way. Flat ends close it.
  void lathe(const std::vector<Eigen::Vector2d>& profile, int corners);
  /// Quadrangles between rings of as many corners, each counter-clockwise seen from the next; flat
  /// ends close the tube.
  void tube(const std::vector<Ring>& rings);

  void polygon(const Ring& corners);
  Mesh finish();

 private:
  void wall(const Outline& outline, double z0, double z1, bool inward);
  std::uint32_t vertex(const Eigen::Vector3d& point);

  Eigen::Isometry3d frame_ = Eigen::Isometry3d::Identity();
  formats::RawMesh mesh_;
  std::map<std::tuple<long, long, long>, std::uint32_t> vertex_at_;
};

}  // namespace posevote::simulate
