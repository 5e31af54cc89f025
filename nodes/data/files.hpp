// SPDX-License-Identifier: BSD-3-Clause
// What a frame begins with: the file to load, and what is known about it before it is read. A
// program that has the scan or the model in memory hands it over in the file's place.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nodes/data/symmetries.hpp"
#include "nodes/data/texture.hpp"

namespace posevote {

/// Pinhole camera of a depth image, as in BOP's `scene_camera.json`.
struct Camera {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< [pixel]
  double depth_scale = 1;  ///< raw depth value x depth_scale = depth in mm; 0: not said
};

/// A point file's content.
struct LoadedPoints {
  Scan scan;  ///< in the file's unit
  bool knows_sensor = false;
};

/// A depth image's content, row by row.
struct LoadedDepth {
  std::size_t width = 0, height = 0;
  std::vector<float> depths;                  ///< [m]; 0 or not finite: no measurement
  std::shared_ptr<const ColorImage> color{};  ///< of the same pixels, or null
};

/// One scan of a batch.
struct SceneFile {
  std::filesystem::path path;  ///< with the scan in memory: its name in messages
  int scene_id = 0;
  int im_id = 0;
  std::optional<Camera> camera;  ///< given where the data set says it; else load_scene's parameters
  std::shared_ptr<const LoadedPoints> points{};  ///< in the file's place, or null
  std::shared_ptr<const LoadedDepth> depth{};    ///< the same of a depth image
  std::filesystem::path color{};  ///< image of a depth image's colours, registered to it, or empty
  std::string hash{};  ///< formats::hash_scan of it, before anybody reads it; empty: not known
};

/// One object model.
struct ModelFile {
  std::filesystem::path path;
  int obj_id = 1;
  std::string name;  ///< file stem, the name in reports
  std::optional<Symmetries>
      symmetries{};  ///< as a models_info.json beside it says; else they are found
  std::shared_ptr<const Mesh> mesh{};  ///< in the file's place and unit, or null
};

using ModelFiles = std::vector<ModelFile>;

}  // namespace posevote
