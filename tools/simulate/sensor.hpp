// SPDX-License-Identifier: BSD-3-Clause
// Instruments: what they report where the truth is known. Sensor frame: x right, y down, z forward.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"
#include "nodes/formats/depth_image.hpp"

namespace posevote {

/// A pinhole range sensor. The error along a ray has a deviation of noise + noise_z2 x depth^2.
struct Sensor {
  std::size_t width = 0, height = 0;
  Camera camera;
  double noise = 0;           ///< [m]
  double noise_z2 = 0;        ///< [1/m]
  double grazing_cosine = 0;  ///< no return from surfaces seen at less than this
  double disparity_step = 0;  ///< depths are multiples of it in 1 / depth; 0: not so [1/m]
  double edge_jump = 0;       ///< no return just behind an edge that stands out more; 0: none [m]
  int holes = 0;              ///< patches without return
  bool uneven = false;        ///< rows are left out, more in some parts than in others
  /// Pixels match windows of about that half-width, and share the error of it: it does not average
  /// out over a neighbourhood, and edges run where the windows have them. 0: none [pixels]
  std::size_t window = 0;
  double window_noise_z2 = 0;  ///< deviation of the shared error over depth^2 [1/m]
  double window_shift = 0;     ///< and of where a pixel looks [pixels]
  double edge_shift = 0;       ///< and of where what stands in front ends [pixels]
};

/// Names of sensors: "laser", "rgbd" ...
const std::vector<std::string>& sensor_names();
/// Throws std::invalid_argument for an unknown name.
Sensor find_sensor(const std::string& name);

/// What a ray through each pixel meets first, row by row.
struct TrueDepth {
  std::vector<double> depth;   ///< z [m]; 0: nothing
  std::vector<double> cosine;  ///< of the angle between ray and surface normal
};

/// The direction of the ray through a pixel, or a place beside the image, with z = 1.
Eigen::Vector3d ray_of(const Camera& camera, double u, double v);

/// The image that the sensor takes. The same seed gives the same bits at any number of threads.
formats::DepthImage take_image(const TrueDepth& truth, const Sensor& sensor, std::uint64_t seed);

}  // namespace posevote
