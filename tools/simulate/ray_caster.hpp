// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "tools/simulate/scene.hpp"

namespace posevote {

/// Finds what a ray from a sensor's origin meets first (Embree 3). Threads may share it.
class RayCaster {
 public:
  struct Hit {
    std::size_t body;        ///< index into the bodies
    double distance;         ///< along the ray, in lengths of `direction` [m where that is unit]
    double cosine;           ///< of the angle between ray and surface normal, in [0, 1]
    Eigen::Vector3d normal;  ///< unit, of either side
  };

  /// The bodies as seen from the sensor. Throws std::runtime_error if Embree fails.
  RayCaster(const std::vector<Body>& bodies, const Eigen::Isometry3d& T_sensor_world);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// The first surface in a direction, of the sensor's frame.
  std::optional<Hit> first_hit(const Eigen::Vector3d& direction) const;

  /// Corners of a body, in the sensor's frame [m].
  const std::vector<Eigen::Vector3f>& vertices(std::size_t body) const;

 private:
  struct Geometry;
  std::unique_ptr<Geometry> geometry_;
};

}  // namespace posevote
