// SPDX-License-Identifier: BSD-3-Clause
// Which point of a scan a point of a posed model is held by: what ICP moves a pose by, and what its
// covariance is read from.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::geometry {

/// A posed model point on its scan point's tangent plane.
struct IcpPair {
  Eigen::Index row = 0;                              ///< of the model
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< of the model, in the scan's frame [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the scan
  double residual = 0;                               ///< signed distance to the plane [m]
  double weight = 0;                                 ///< Tukey's biweight of `distance`, > 0
};

/// Of about `most` points of the model, evenly strewn, those that face the sensor and have a scan
/// point that looks their way within `distance` [m].
std::vector<IcpPair> find_icp_pairs(const Cloud& model, const ScanSurface& scan,
                                    const Eigen::Isometry3f& T_scene_model, float distance,
                                    Eigen::Index most);

/// Leaves out pairs of no weight, and makes the weights of others, which are off by `spread` [m], one
/// deviation, those of points on planes, whose residuals have this variance [m^2].
void weigh_beside_planes(std::vector<IcpPair>& pairs, double variance, double spread,
                         double resolution);

/// Of a residual, if they were independent [m^2]. For IcpPair and whatever else has a weight and a
/// residual.
template <class Pair>
double variance_of(const std::vector<Pair>& pairs) {
  double squares = 0, weight = 0;
  for (const Pair& pair : pairs) {
    squares += pair.weight * pair.residual * pair.residual;
    weight += pair.weight;
  }
  return squares / weight;
}

}  // namespace posevote::geometry
