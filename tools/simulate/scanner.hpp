// SPDX-License-Identifier: BSD-3-Clause
// What a sensor sees of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/texture.hpp"
#include "tools/simulate/scene.hpp"
#include "tools/simulate/sensor.hpp"

namespace posevote {

/// A rectangle of pixels; empty: width 0.
struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
};

/// How much of a body is seen, in pixels and of its surface.
struct BodyView {
  int alone = 0;    ///< if nothing else were there, and the image went on beyond its edges
  int visible = 0;  ///< of those, not hidden by another body
  int valid = 0;    ///< of `alone`, those where the image has a depth, of whatever body
  PixelBox box_alone, box_visible;
  double surface = 0;  ///< area of the triangles whose middles are seen, over that of all
  double fraction() const { return alone > 0 ? static_cast<double>(visible) / alone : 0; }
};

/// What the sensor measured, and what is true of it.
struct SimulatedScan {
  formats::DepthImage depth;
  std::vector<BodyView> views;  ///< one a body
  ColorImage colors{};          ///< of the same pixels; empty: a sensor without colour
};

/// BodyView::surface of each object alone, in a fraction of a scan's time; 0 for other bodies.
std::vector<double> seen_surfaces(const std::vector<Body>& bodies, const Sensor& sensor,
                                  const Eigen::Isometry3d& T_world_sensor);

/// Scans the bodies. The same arguments give the same bits at any number of threads.
SimulatedScan scan(const std::vector<Body>& bodies, const Sensor& sensor,
                   const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed);

/// The points that a depth image holds [m], row by row, in the sensor's frame.
Scan points_of(const formats::DepthImage& depth, const Camera& camera);

/// A sensor that looks at `target` from `distance`, `elevation` above the horizon and `azimuth`
/// around it [m, rad].
Eigen::Isometry3d look_at(const Eigen::Vector3d& target, double distance, double elevation,
                          double azimuth);

}  // namespace posevote
