// SPDX-License-Identifier: BSD-3-Clause
// The truth of a data set in BOP layout. Files are in mm; everything here is in m.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

struct TrueInstance {
  int scene_id = 0, im_id = 0, obj_id = 0;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  std::optional<double> visible;  ///< fraction in [0, 1], where scene_gt_info.json is present
};

struct TrueObject {
  double diameter = 0;                               ///< [m]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the bounding box [m]
  PointMatrix points;                                ///< the model's vertices [m]
  std::vector<Eigen::Isometry3d> symmetries;         ///< identity first
  std::vector<Eigen::Vector3d> axes;                 ///< of continuous symmetries, unit
  bool symmetric() const { return symmetries.size() > 1 || !axes.empty(); }
};

struct GroundTruth {
  std::vector<TrueInstance> instances;  ///< by scene, image, and place in scene_gt.json
  std::set<std::pair<int, int>> images;
  std::map<int, TrueObject> objects;  ///< by obj_id
};

/// Reads `DATASET/SPLIT/NNNNNN/scene_gt.json` and scene_gt_info.json, models/models_info.json and
/// the models that occur. Throws std::runtime_error naming a file that is missing, malformed, or
/// contradicts another.
GroundTruth read_ground_truth(const std::filesystem::path& dataset, const std::string& split);

}  // namespace posevote
