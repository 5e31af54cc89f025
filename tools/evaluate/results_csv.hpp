// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "nodes/geometry/twist.hpp"

namespace posevote {

/// A row of a BOP results file.
struct FoundInstance {
  int line = 0;  ///< of the file, from 1
  int scene_id = 0, im_id = 0, obj_id = 0;
  double score = 0;  ///< or the confidence, where there is one
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();  ///< [m]
  // What a CSV does not have:
  std::optional<geometry::Matrix6d> covariance{};  ///< of the pose
  std::optional<double> pose_confidence{};         ///< nodes/data/detections.hpp
};

/// Reads `scene_id,im_id,obj_id,score,R,t,time` (R: 9 numbers row by row; t in mm; both separated
/// by spaces); the first line may name an eighth column, `confidence`, which then takes the place of
/// the score. Throws std::runtime_error "file:line: what is wrong" for the first bad row.
std::vector<FoundInstance> read_results_csv(const std::string& file);

}  // namespace posevote
