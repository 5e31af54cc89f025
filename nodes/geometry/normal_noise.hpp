// SPDX-License-Identifier: BSD-3-Clause
// How far a sensor's noise tilts the normals of a scan, measured from the scan itself. White noise
// averages out over a neighbourhood; that of depth cameras does not, since their pixels share
// windows of correlation and steps of disparity: normals stay tilted by some degrees over a
// centimetre and more, however small the noise of single points is. So both are measured.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/spread.hpp"

namespace posevote::geometry {

/// The points of a scan in cubes: what each of these holds, which is all that planes through them
/// take, and all that cubes twice as wide do.
class NoiseCubes {
 public:
  /// Of the points with the numbers `rows`, in cubes of edge `width` [m].
  NoiseCubes(const PointMatrix& points, const std::vector<std::uint32_t>& rows, float width);

  /// Makes the cubes twice as wide.
  void widen();

  /// Standard deviation of the tilt of normals about either axis [rad], of planes through the points
  /// of a cube: how far its normal lies off the mean of those of its two opposite neighbours. Taken
  /// where the surface is flattest, the lowest quarter, so that curvature and edges count little.
  /// Nothing where fewer than twenty cubes have such neighbours.
  std::optional<float> tilt(const Eigen::Vector3f& viewpoint) const;

 private:
  struct Cube {
    std::array<std::uint32_t, 3> cell;  ///< along z, y, x
    double count;
    Moments moments;
  };
  double width_;
  std::vector<Cube> cubes_;  ///< by cell
};

}  // namespace posevote::geometry
