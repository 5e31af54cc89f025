// SPDX-License-Identifier: BSD-3-Clause
// A point cloud or triangle mesh: the noun that loading and preparation pass along.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>

namespace posevote {

// PCL's Debian binaries and our code must agree on how Eigen allocates; an -mavx build of code that
// sees Eigen would not, and crashes when one side frees what the other allocated.
static_assert(EIGEN_MALLOC_ALREADY_ALIGNED,
              "build without -march=native and -mavx: see nodes/data");

/// n x 3 floats, column-major: all x, then all y, then all z, so kernels read contiguous arrays.
using PointMatrix = Eigen::Matrix<float, Eigen::Dynamic, 3>;
/// m x 3 vertex indices, one triangle a row.
using FaceMatrix = Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Points with optional normals and faces. Lengths in metres. A scan lives in the sensor's frame, a
/// model in its own frame.
struct Cloud {
  PointMatrix points;   ///< n x 3 [m]
  PointMatrix normals;  ///< n x 3 unit vectors, or 0 x 3 where there are none. Scenes: toward the
                        ///< sensor; models: outward. An unusable normal is (0, 0, 0).
  FaceMatrix faces;     ///< m x 3 indices into points, or 0 x 3 for a raw cloud
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();  ///< sensor origin [m] (scans only)
  Eigen::AlignedBox2f image;  ///< of a depth image: what its pixels span in x / z and y / z, seen
                              ///< from the viewpoint; empty where that is not known
  Eigen::Vector2i pixels =
      Eigen::Vector2i::Zero();  ///< of that image, columns and rows; 0: unknown
  std::size_t dropped = 0;      ///< points left out so far: not finite, or without a usable normal
};

}  // namespace posevote
