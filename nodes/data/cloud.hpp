// SPDX-License-Identifier: BSD-3-Clause
// Surfaces made of points: models and scans as they are loaded, and the oriented points that the
// method makes of them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>

namespace posevote {

// PCL's Debian binaries and our code must agree on how Eigen allocates; an -mavx build of code that
// sees Eigen would not, and crashes when one side frees what the other allocated.
static_assert(EIGEN_MALLOC_ALREADY_ALIGNED,
              "build without -march=native and -mavx: see nodes/data");

/// n x 3 floats, column-major: all x, then all y, then all z, so kernels read contiguous arrays.
using PointMatrix = Eigen::Matrix<float, Eigen::Dynamic, 3>;
/// m x 3 vertex indices, one triangle a row.
using FaceMatrix = Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// n x 3 floats, red, green and blue in [0, 1], proportional to light (sRGB without its gamma), so
/// that the mean of some is the colour of them all; one a point, or 0 x 3 where there are none.
using ColorMatrix = Eigen::Matrix<float, Eigen::Dynamic, 3>;

struct Texture;

/// Where a sensor stood, and what its image spans.
struct View {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< of the sensor, in the scan's frame [m]
  Eigen::AlignedBox2f image;  ///< of a depth image: what its pixels span in x / z and y / z, seen
                              ///< from the origin; empty where that is not known
  Eigen::Vector2i pixels =
      Eigen::Vector2i::Zero();  ///< of that image, columns and rows; 0: unknown
};

/// Oriented points, which the method works on from the normals to the poses: of a scan, in its
/// sensor's frame, or of a model, in the model's own frame.
struct Cloud {
  PointMatrix points;    ///< n x 3 [m]
  PointMatrix normals;   ///< n x 3 unit vectors. Scans: toward the sensor; models: outward. An
                         ///< unusable normal is (0, 0, 0).
  View view;             ///< of a scan; of a model it says nothing
  ColorMatrix colors{};  ///< n x 3 or 0 x 3
};

/// A model's surface as it was loaded, in its own frame.
struct Mesh {
  PointMatrix points;    ///< n x 3 [m]
  PointMatrix normals;   ///< n x 3, as the file has them, or 0 x 3 where it has none
  FaceMatrix faces;      ///< m x 3 indices into points, or 0 x 3 for a raw cloud
  ColorMatrix colors{};  ///< n x 3 or 0 x 3
  std::shared_ptr<const Texture> texture{};  ///< in place of colours (texture.hpp), or null
};

/// What a sensor measured, as it was loaded, in the sensor's or the file's frame. It is a Mesh, so
/// that what works on surfaces takes both.
struct Scan : Mesh {
  View view;
};

}  // namespace posevote
