// SPDX-License-Identifier: BSD-3-Clause
// The camera of a folder of depth images, from the file that stands beside them.
#pragma once

#include <filesystem>
#include <optional>

#include "nodes/data/files.hpp"

namespace posevote::layouts {

/// From camera.json (fx, fy, cx, cy and depth_scale, as BOP's; or cam_K, row by row; or Open3D's
/// intrinsic_matrix, column by column), camera_intrinsic.json, intrinsics.json (the same), or
/// intrinsics.txt, camera-intrinsics.txt (fx fy cx cy, or the 3 x 3 matrix) in the folder. Nothing
/// where there is none of them. depth_scale is 0 where the file does not say it. Throws
/// std::runtime_error, which names the file.
std::optional<Camera> find_camera(const std::filesystem::path& folder);
/// Of a depth image: from its folder, else from the one above.
std::optional<Camera> camera_beside(const std::filesystem::path& image);

}  // namespace posevote::layouts
