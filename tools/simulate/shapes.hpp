// SPDX-License-Identifier: BSD-3-Clause
// Procedural objects: closed, wound outward. Free forms, asymmetric and rich in features, and goods
// (goods.hpp), both finely meshed; parts (parts.hpp) and household objects (household.hpp) of few
// triangles. Each shape is a kind; each seed makes another individual of it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// Kinds of objects: "boulder", "horn", "coral" ...
const std::vector<std::string>& shape_names();

/// Those of them that are finely meshed, which clutter is made of.
const std::vector<std::string>& fine_shape_names();

/// How a kind maps onto itself, about its bounding box' centre; meshes of the user's own about any.
struct ShapeSymmetry {
  bool is_round = false;                             ///< however it is turned about z
  std::vector<Eigen::Matrix3d> turns{};              ///< without the identity
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< stays where it is [m]
  std::vector<Eigen::Vector3d> axes{};               ///< round about these, too
};
ShapeSymmetry symmetry_of(const std::string& shape);

/// Thrown for what chance made too thin for a mesh; another seed makes another one.
struct TooThin : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A mesh whose bounding box is centred at the origin and `size` [m] long on its longest side: fine
/// ones have about 5 000 to 50 000 vertices, the others at most 1000 triangles. Throws
/// std::invalid_argument for an unknown shape, TooThin.
Mesh make_shape(const std::string& shape, std::uint64_t seed, double size);

/// The same, stretched to the three sides of a box [m].
Mesh make_shape(const std::string& shape, std::uint64_t seed, const Eigen::Vector3d& sides);

}  // namespace posevote
