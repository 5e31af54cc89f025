// SPDX-License-Identifier: BSD-3-Clause
// What colour simulated things have: a function of where on the body, the same for the model and for
// what the camera sees.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/data/texture.hpp"

namespace posevote {

class Paint {
 public:
  /// `shape` says of what kind: cartons, cans and bottles are printed, in fields of several colours
  /// with finer print on them; other things have few colours. A `ground` has one, dull.
  Paint(const Mesh& mesh, const std::string& shape, std::uint64_t seed);
  static Paint ground(std::uint64_t seed);

  /// Share of the light that comes back, red, green and blue; at a place in the body's frame [m].
  Eigen::Vector3f at(const Eigen::Vector3d& place) const;

 private:
  struct Field {
    Eigen::Vector3d middle;  ///< in the unit cube of the bounding box
    Eigen::Vector3f color, print;
    Eigen::Vector3d across;  ///< of its lines of print: unit over their distance [1 / m]; 0: none
  };

  Paint() = default;
  void add_field(class Random& random, const std::vector<Eigen::Vector3f>& palette, bool printed);

  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), size_ = Eigen::Vector3d::Ones();
  std::vector<Field> fields_;
};

/// A mesh's paint as an image: each face has a tile of its own.
struct PaintedFaces {
  ColorImage image;
  Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::RowMajor>
      places;  ///< per face: u, v of its corners
};

/// Of meshes of some hundred faces; those of more have a colour a vertex.
PaintedFaces paint_faces(const Mesh& mesh, const Paint& paint);
std::vector<std::array<std::uint8_t, 3>> paint_points(const Mesh& mesh, const Paint& paint);

}  // namespace posevote
