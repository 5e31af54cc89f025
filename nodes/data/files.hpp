// SPDX-License-Identifier: BSD-3-Clause
// What a frame begins with: the file to load, and what is known about it before it is read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nodes/data/symmetries.hpp"

namespace posevote {

/// Pinhole camera of a depth image, as in BOP's `scene_camera.json`.
struct Camera {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< [pixel]
  double depth_scale = 1;                 ///< raw depth value x depth_scale = depth in mm
};

/// One scan of a batch.
struct SceneFile {
  std::filesystem::path path;
  int scene_id = 0;
  int im_id = 0;
  std::optional<Camera> camera;  ///< given where the data set says it; else load_scene's parameters
};

/// One object model.
struct ModelFile {
  std::filesystem::path path;
  int obj_id = 1;
  std::string name;  ///< file stem, the name in reports
  std::optional<Symmetries>
      symmetries{};  ///< as a models_info.json beside it says; else they are found
};

using ModelFiles = std::vector<ModelFile>;

}  // namespace posevote
