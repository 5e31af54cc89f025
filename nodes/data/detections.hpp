// SPDX-License-Identifier: BSD-3-Clause
// The answer of a frame.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "nodes/data/clues.hpp"
#include "nodes/data/symmetries.hpp"

namespace posevote {

/// One found instance of one object.
struct Detection {
  int obj_id = 0;
  std::string model;
  double confidence = 0;         ///< in [0, 1]: the probability that the object lies so, or so that
                                 ///< what the scan shows of it is the same
  Clues clues{};                 ///< what the confidence was made from
  double score = 0;              ///< in [0, 1]: how well it fits
  double density = 0;            ///< of the mode, raw (before anything was subtracted)
  double runner_up_density = 0;  ///< highest raw density of the same object farther than 20 % of
                                 ///< the bounding-box diagonal from the mode
  double inlier_fraction = 0;  ///< of the model points that face the sensor, those on scene points
  double rmse = 0;             ///< point-to-plane, over the inliers [m]
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();  ///< [m]
  /// Of the pose error xi, a twist in the model's frame (its translation [m] first, then its turn
  /// [rad]): T_true = T_scene_model exp(xi). Empty-handed of a pose that was not refined.
  std::optional<Eigen::Matrix<double, 6, 6>> covariance{};
  double seconds = 0;     ///< that the search for it took (poses/object_search.hpp)
  Symmetries symmetries;  ///< of the model: poses that look the same, in colour where that is known
  std::vector<LookAlike> look_alikes{};  ///< other poses that the scan does not tell from this one
  double identity = 1;  ///< the probability that it is this object, and no other that fits there
  std::optional<ColorClues> colors{};  ///< part of the clues, where scan and model have any
  Clues against{};  ///< what each clue takes from the log odds, beside usual right detections
  std::string why;  ///< of a rejected one: the threshold that it missed

  /// The confidence that it is none of its look_alikes instead, and no other object.
  double pose_confidence() const {
    double left = confidence;
    for (const LookAlike& other : look_alikes) left -= confidence * other.probability;
    return left * identity;
  }
};

/// All detections of a frame, in descending order of confidence.
struct Detections {
  std::vector<Detection> items;
  std::vector<Detection> rejected{};  ///< the best of what is none, a few of each object
};

}  // namespace posevote
