// SPDX-License-Identifier: BSD-3-Clause
// Iterative closest points, point to plane (Chen, Medioni 1992), for a model that is mostly hidden:
// the model points that face the sensor look for scan points, within a distance that shrinks from
// iteration to iteration. Weights fall smoothly to zero at that distance (Tukey's biweight), so
// hidden parts and clutter drop out without a jump. Each step solves the 6 x 6 normal equations in
// double by their eigenvectors, damped as Levenberg does: on a plane or a sphere the directions
// that nothing holds stay where they are instead of following noise. Cost: iterations x sampled
// points x one nearest-neighbour search.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/icp_pairs.hpp"
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::geometry {

/// Constants of the method; poses/term_params.cpp says where they come from.
struct IcpTerms {
  int fewest_pairs = 10;  ///< fewer hold no pose
  double shrink = 0.85;   ///< of the search radius per iteration
  /// Added to eigenvalues, as shares of the pairs' weight: weakly held directions take several
  /// small steps as long as chance partners are many, and get there once the search radius is the
  /// last. What nothing holds has no gradient either, and stays.
  double damping = 0.01, final_damping = 1e-3;
};

struct IcpParams {
  int iterations = 40;
  float start_distance = 0;     ///< search radius of the first iteration [m]
  float end_distance = 0;       ///< and of the last ones [m]
  Eigen::Index samples = 2000;  ///< model points at most, of which about half face the sensor
  double still = 2e-3;          ///< of end_distance: a shorter step ends the search
  bool follows_drift = true;    ///< steps that do not shorten end it, but for those that lead on
  IcpTerms terms{};
};

/// Pairs beside those of points and planes, whose residuals have a variance [m^2].
using MorePairs = std::function<std::vector<IcpPair>(const Eigen::Isometry3d&, double variance)>;

/// The refined T_scene_model; the start where too few points find a partner. Never NaN. `pass`: is
/// called with each pose on the way, but for the start. `more`: of a pose, or empty.
Eigen::Isometry3d icp(const Cloud& model, const ScanSurface& scan, const Eigen::Isometry3d& start,
                      const IcpParams& params,
                      const std::function<void(const Eigen::Isometry3d&)>& pass = {},
                      const MorePairs& more = {});

}  // namespace posevote::geometry
