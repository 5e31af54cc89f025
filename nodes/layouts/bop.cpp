// SPDX-License-Identifier: BSD-3-Clause
// BOP: models/obj_NNNNNN.ply, models/models_info.json, SPLIT/NNNNNN/{depth/NNNNNN.png,
// scene_camera.json, scene_gt.json, scene_gt_info.json}; colour images and masks are not needed.
#include "nodes/layouts/image_folders.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;

constexpr ImageFolders kNames{"scene_gt.json", "scene_camera.json", "scene_gt_info.json",
                              "models_info.json", read_json};

bool recognises(const fs::path& folder, const std::string& split) {
  return has_scene_files(kNames, folder, split) ||
         fs::exists(folder / "models" / kNames.models_info);
}

std::vector<SceneFile> scenes(const fs::path& folder, const std::string& split) {
  return list_images(kNames, folder, split);
}

GroundTruth truth(const fs::path& folder, const std::string& split) {
  return read_truth(kNames, folder, split);
}

const auto registered = register_layout(
    {"BOP", "models/models_info.json, SPLIT/NNNNNN/{depth, scene_camera.json, scene_gt.json}",
     recognises, scenes, list_model_files, truth});

}  // namespace
}  // namespace posevote::layouts
