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

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::geometry {

/// Constants of the method; poses/term_params.cpp says where they come from.
struct IcpTerms {
  int few_points = 500;    ///< model points that show the way
  double few_until = 0.5;  ///< of the iterations, at most
  double slow = 0.1;       ///< of the final search radius: a shorter step calls for the many
  int fewest_pairs = 10;   ///< fewer hold no pose
  double shrink = 0.85;    ///< of the search radius per iteration
  /// Eigenvalues, as shares of the pairs' weight. Directions below the first are not moved at all;
  /// weakly held ones take several small steps as long as chance partners are many, and get there
  /// once the search radius is the last.
  double unobserved = 1e-4, damping = 0.01, final_damping = 1e-3;
  double most_turn = 0.2;  ///< [rad] per iteration
};

struct IcpParams {
  int iterations = 40;
  float start_distance = 0;  ///< search radius of the first iteration [m]
  float end_distance = 0;    ///< and of the last ones [m]
  /// Model points at most, of which about half face the sensor. Few show the way until steps are
  /// short, or half of the iterations are done; none where the radius is the last from the start.
  Eigen::Index samples = 2000;
  double still = 2e-3;  ///< of end_distance: a shorter step of all of them ends the search
  IcpTerms terms{};
};

/// The refined T_scene_model; the start where too few points find a partner. Never NaN.
Eigen::Isometry3d icp(const Cloud& model, const ScanSurface& scan, const Eigen::Isometry3d& start,
                      const IcpParams& params);

}  // namespace posevote::geometry
