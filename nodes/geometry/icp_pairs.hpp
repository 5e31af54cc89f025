// SPDX-License-Identifier: BSD-3-Clause
// Which point of a scan a point of a posed model is held by: what ICP moves a pose by, and what its
// covariance is read from.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/data/cloud.hpp"
#include "nodes/geometry/scan_surface.hpp"
#include "nodes/geometry/strewn.hpp"

namespace posevote::geometry {

/// A posed model point on its scan point's tangent plane.
struct IcpPair {
  Eigen::Index row = 0;                              ///< of the model
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< of the model, in the scan's frame [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the scan
  double residual = 0;                               ///< signed distance to the plane [m]
  double weight = 0;                                 ///< Tukey's biweight of `distance`, > 0
};

/// Tukey's biweight. `inside`: 1 less the square of what is off over what is looked at.
template <class Number>
double biweight(Number inside) {
  return static_cast<double>(inside > 0 ? inside * inside : 0);
}

/// What is found of about `most` points of a model, but for pairs of no weight. find(rows, begin, end,
/// add) calls add(k, pair) of rows[k], for any of begin to end - 1; from many threads.
template <class Find>
std::vector<IcpPair> strewn_pairs(const Cloud& model, Eigen::Index most, const Find& find) {
  const Strewn rows(model.points.rows(), most);
  std::vector<IcpPair> pairs(rows.size());
  graph::parallel_ranges(pairs.size(), 256, [&](std::size_t begin, std::size_t end) {
    find(rows, begin, end, [&](std::size_t k, const IcpPair& pair) {
      pairs[k] = pair;
      pairs[k].row = rows[k];
    });
  });
  std::erase_if(pairs, [](const IcpPair& pair) { return !(pair.weight > 0); });
  return pairs;
}

/// Of about `most` points of the model, evenly strewn, those that face the sensor and have a scan
/// point that looks their way within `distance` [m].
std::vector<IcpPair> find_icp_pairs(const Cloud& model, const ScanSurface& scan,
                                    const Eigen::Isometry3f& T_scene_model, float distance,
                                    Eigen::Index most);

/// Makes the weights of pairs that are off by `spread` [m], one deviation, those of points on planes,
/// whose residuals have this variance [m^2]: less, by how much more exactly planes hold.
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
