// SPDX-License-Identifier: BSD-3-Clause
// BOP: models/obj_NNNNNN.ply, models/models_info.json, SPLIT/NNNNNN/{depth/NNNNNN.png,
// scene_camera.json, scene_gt.json, scene_gt_info.json}; colour images and masks are not needed.
#include "tools/evaluate/image_folders.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

constexpr dataset::ImageFolders kNames{"scene_gt.json", "scene_camera.json", "scene_gt_info.json",
                                       "models_info.json", dataset::read_json};

bool recognises(const fs::path& folder, const std::string& split) {
  return dataset::has_scene_files(kNames, folder, split) ||
         fs::exists(folder / "models" / kNames.models_info);
}

std::vector<SceneFile> scenes(const fs::path& folder, const std::string& split) {
  return dataset::list_images(kNames, folder, split);
}

GroundTruth truth(const fs::path& folder, const std::string& split) {
  return dataset::read_truth(kNames, folder, split);
}

}  // namespace

const DatasetReader kBopReader{
    "BOP",
    "models/models_info.json, SPLIT/NNNNNN/{depth, scene_camera.json, scene_gt.json}",
    recognises,
    scenes,
    dataset::list_model_files,
    truth};

}  // namespace posevote
