// SPDX-License-Identifier: BSD-3-Clause
// BOP: models/obj_NNNNNN.ply, models/models_info.json, SPLIT/NNNNNN/{depth/NNNNNN.png,
// scene_camera.json, scene_gt.json, scene_gt_info.json}; colour images and masks are not needed.
#include "nodes/layouts/image_folders.hpp"

namespace posevote::layouts {
namespace {

constexpr ImageFolders kNames{"scene_gt.json", "scene_camera.json", "scene_gt_info.json",
                              "models_info.json", read_json};

const auto registered = register_layout(
    layout_of(kNames, "BOP",
              "models/models_info.json, SPLIT/NNNNNN/{depth, scene_camera.json, scene_gt.json}"));

const auto scene = register_recording(scene_of(kNames, "BOP scene"));

}  // namespace
}  // namespace posevote::layouts
