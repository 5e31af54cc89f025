// SPDX-License-Identifier: BSD-3-Clause
// Sensors, and what they see of a scene. Sensor frame: x right, y down, z forward.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"
#include "nodes/load/png_depth.hpp"
#include "tools/simulate/scene.hpp"

namespace posevote {

/// A pinhole range sensor. The error along a ray has a deviation of noise + noise_z2 x depth^2.
struct Sensor {
  std::size_t width = 0, height = 0;
  Camera camera;
  double noise = 0;           ///< [m]
  double noise_z2 = 0;        ///< [1/m]
  double grazing_cosine = 0;  ///< no return from surfaces seen at less than this
};

/// Names of sensors: "laser", "rgbd".
const std::vector<std::string>& sensor_names();
/// Throws std::invalid_argument for an unknown name.
Sensor find_sensor(const std::string& name);

/// A rectangle of pixels; empty: width 0.
struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
};

/// How much of a body is seen, in pixels.
struct BodyView {
  int alone = 0;    ///< if nothing else were there
  int visible = 0;  ///< of those, not hidden by another body
  int valid = 0;    ///< of `alone`, those where the image has a depth, of whatever body
  PixelBox box_alone, box_visible;
  double fraction() const { return alone > 0 ? static_cast<double>(visible) / alone : 0; }
};

struct Scan {
  DepthImage depth;
  std::vector<BodyView> views;  ///< one a body
};

/// Scans the bodies. The same arguments give the same bits at any number of threads.
Scan scan(const std::vector<Body>& bodies, const Sensor& sensor,
          const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed);

/// The points that a depth image holds [m], row by row, in the sensor's frame.
Cloud points_of(const DepthImage& depth, const Camera& camera);

/// A sensor that looks at `target` from `distance`, `elevation` above the horizon and `azimuth`
/// around it [m, rad].
Eigen::Isometry3d look_at(const Eigen::Vector3d& target, double distance, double elevation,
                          double azimuth);

}  // namespace posevote
