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

struct IcpParams {
  int iterations = 40;
  float start_distance = 0;  ///< search radius of the first iteration [m]
  float end_distance = 0;    ///< and of the last ones [m]
  /// Model points at most, of which about half face the sensor. 500 show the way until steps are
  /// short, or half of the iterations are done; none where the radius is the last from the start.
  Eigen::Index samples = 2000;
  double still = 2e-3;  ///< of end_distance: a shorter step of all of them ends the search
};

/// The refined T_scene_model; the start where fewer than 10 points find a partner. Never NaN.
Eigen::Isometry3d icp(const Cloud& model, const ScanSurface& scan, const Eigen::Isometry3d& start,
                      const IcpParams& params);

}  // namespace posevote::geometry
