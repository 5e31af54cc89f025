// SPDX-License-Identifier: BSD-3-Clause
// The truth of a data set, whatever its layout. Files are in mm; everything here is in m.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/data/files.hpp"

namespace posevote::layouts {

struct TrueInstance {
  int scene_id = 0, im_id = 0, obj_id = 0;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  std::optional<double> visible;  ///< fraction in [0, 1], where the set says it
};

/// An object that looks the same however it is turned about this axis.
struct SymmetryAxis {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();      ///< a point of the axis [m]
};

struct TrueObject {
  std::string name;
  double diameter = 0;                               ///< [m]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the bounding box [m]
  PointMatrix points;                                ///< the model's vertices [m]
  FaceMatrix faces;                                  ///< may be empty
  std::vector<Eigen::Isometry3d> symmetries;         ///< identity first
  std::vector<SymmetryAxis> axes;                    ///< of continuous symmetries
  bool symmetric() const { return symmetries.size() > 1 || !axes.empty(); }
};

using ImageKey = std::pair<int, int>;  ///< scene_id, im_id

/// What is known of an image; errors measured in pixels or against the depth need it.
struct TrueImage {
  std::optional<Camera> camera;
  std::filesystem::path depth;  ///< empty: none
};

struct GroundTruth {
  std::vector<TrueInstance> instances;  ///< by scene, image, and place in the file
  std::map<ImageKey, TrueImage> images;
  std::set<ImageKey> left_out;        ///< images of the set without known poses: not judged
  std::map<int, TrueObject> objects;  ///< by obj_id
  /// How many instances a list of targets asks for, by scene, image, object; empty: all count.
  std::map<std::tuple<int, int, int>, int> targets;
  std::vector<std::string> notes;  ///< what was left out, and why
};

/// Reads the poses, cameras and models of a split. `targets`: a list like
/// `test_targets_bop19.json`, which says which images are judged, and that of each object the
/// `inst_count` most visible instances count; "" takes that of the data set, if its split "test"
/// has one, "none" judges everything. Throws std::runtime_error naming a file that is missing,
/// malformed, or contradicts another.
GroundTruth read_ground_truth(const std::filesystem::path& dataset, const std::string& split,
                              const std::string& targets = "");

}  // namespace posevote::layouts
