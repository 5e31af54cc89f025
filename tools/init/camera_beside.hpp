// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "nodes/data/files.hpp"

namespace posevote::init {

struct FoundCamera {
  Camera camera;               ///< depth_scale 1 where the file does not say it
  std::filesystem::path file;  ///< that says it
};

/// The camera of a depth image as a file beside it, or one folder up, says it: JSON or YAML with
/// fx, fy, cx and cy (or ppx, ppy), or a matrix cam_K, K, camera_matrix or intrinsic_matrix, as
/// BOP's scene_camera.json (of the image's own number, where it has one), ROS's camera info, Open3D
/// and RealSense write them; or a text of the 3 x 3 matrix whose name holds "intrinsic" or "camera".
/// Files that are something else are passed over.
std::optional<FoundCamera> camera_beside(const std::filesystem::path& image);

}  // namespace posevote::init
