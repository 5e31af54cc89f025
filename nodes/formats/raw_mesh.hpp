// SPDX-License-Identifier: BSD-3-Clause
// What the readers of point files hand over: numbers as they stand in the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nodes/data/texture.hpp"

namespace posevote::formats {

using Triple = std::array<double, 3>;

/// The triangles of a polygon of four corners or more, all from its first corner.
struct Fan {
  std::size_t first = 0;  ///< of RawMesh::faces
  std::size_t count = 0;  ///< of them
};

/// Where a file says that the colours of its faces are. Empty where it says nothing.
struct Paint {
  std::vector<std::array<double, 2>> places;          ///< in images (Texture::places)
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< per face: its corners' among `places`;
                                                      ///< beyond them: not said
  std::vector<std::uint32_t> material_of;             ///< per face
  std::vector<std::string> materials;  ///< their names in the libraries; without those, of images
  std::vector<std::string> libraries;  ///< files, beside the mesh's
};

struct RawMesh {
  std::vector<Triple> points;
  std::vector<Triple> normals;  ///< one a point, or none
  std::vector<Triple> colors;   ///< one a point, or none; in [0, 1], encoded as in sRGB
  Paint paint;
  Texture texture;          ///< of the paint, once its files are read (paint_mesh.hpp)
  std::string color_doubt;  ///< why colours that the file has were left out
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<Fan> fans;  ///< which of the faces are one polygon
  Triple viewpoint{};

  /// Adds a polygon as a fan of triangles. Fewer than three corners are no face and add nothing.
  void add_polygon(std::span<const std::uint32_t> corners);
  /// The same with the corners' places in an image, as many of them.
  void add_polygon(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> places,
                   std::uint32_t material);
  /// Colours as a file has them: some points' alone are left out, with a doubt; where a value is
  /// beyond 1 all are bytes.
  void settle_colors();
};

/// Scales to metres; leaves out points that are not finite, and the faces that use them; makes
/// normals unit length, or zero where they have no direction. Throws std::runtime_error if no point
/// is left. Every face must refer to points of the mesh.
Scan to_scan(const RawMesh& mesh, double metres_per_unit);

/// Throws std::runtime_error if `count` things of at least `size` bytes cannot be in `room` bytes:
/// asked before anything is allocated. `what` is a plural.
void check_room(std::uint64_t count, const std::string& what, std::uint64_t size,
                std::uint64_t room);

/// What is wrong with a vertex index of a face, counted from 0; "" if it is one of `vertices`.
std::string index_problem(double index, std::uint64_t vertices);

}  // namespace posevote::formats
