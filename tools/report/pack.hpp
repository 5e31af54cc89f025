// SPDX-License-Identifier: BSD-3-Clause
// Points and surfaces in few bytes, as the page's viewer reads them: each coordinate is a whole
// number of 16 bits, a step of the bounding box's longest edge / 65535, from its lowest corner.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::page {

struct Packed {
  std::size_t points = 0, faces = 0;
  Eigen::Vector3f corner = Eigen::Vector3f::Zero();  ///< [m]
  float step = 0;                                    ///< [m]
  std::string
      bytes;  ///< little-endian: x y z of each point; then a byte a point, or corners of faces
};

/// `values`: one byte a point.
Packed pack_points(const PointMatrix& points, const std::vector<std::uint8_t>& values);
/// At most 65536 points. Throws std::invalid_argument otherwise.
Packed pack_mesh(const PointMatrix& points, const FaceMatrix& faces);
/// Bytes that a point takes on the page: its seven in base64.
inline constexpr double kBytesPerPoint = 7 * 4.0 / 3;

/// Points that stand evenly on a surface.
struct Thinned {
  std::vector<std::uint32_t> rows;  ///< ascending
  float spacing = 0;                ///< about how far they are apart [m]
};
/// At most `most` of the finite points, one a cube of space.
Thinned thin(const PointMatrix& points, std::size_t most);

/// The same shape of at most `most` faces and 65536 points: points that share a cube of space become
/// one (Rossignac and Borrel 1993). A mesh of no faces keeps evenly spread points.
Mesh simplify(const Mesh& mesh, std::size_t most);

/// How bright each of the points `rows` of a scan is under a light behind its sensor, 0 to 255. Its
/// own normals serve, else those of its faces, else planes through the points within reach of
/// `spacing` [m].
std::vector<std::uint8_t> shade(const Scan& scan, const Thinned& thinned,
                                const Eigen::Vector3f& light);

}  // namespace posevote::page
