// SPDX-License-Identifier: BSD-3-Clause
// How noisy and how dense a scan is, measured from itself: how far its points lie off small planes,
// and how far from each other. What a sensor resolves at all follows from the two.
#pragma once

#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// A small piece of a scan's surface.
struct Patch {
  float range = 0;    ///< from the sensor [m]
  float noise = 0;    ///< standard deviation from its plane [m]
  float spacing = 0;  ///< of its points [m]
};

/// Noise as it grows with the square of the range and spacing as it grows with the range, which
/// holds for depth cameras (Khoshelham, Oude Elberink, Sensors 2012); the medians over all patches.
struct SensorNoise {
  float noise_per_square = 0;   ///< noise = this times the range squared [1 / m]
  float spacing_per_range = 0;  ///< spacing = this times the range
  float median_range = 0;       ///< of the patches [m]
  std::vector<float> ranges;    ///< of all patches, ascending [m]

  float noise_at(float range) const { return noise_per_square * range * range; }
  float spacing_at(float range) const { return spacing_per_range * range; }
};

/// From patches some six point spacings wide, or wider where the noise is larger than that; those
/// with few points, or that hold an edge, are outvoted. Nothing (zeros, no ranges) where there are none. O(n log n).
SensorNoise measure_noise(const PointMatrix& points, const Eigen::Vector3f& viewpoint);

}  // namespace posevote::geometry
