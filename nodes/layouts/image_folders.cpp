// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/image_folders.hpp"

#include <stdexcept>

#include "nodes/formats/json_text.hpp"
#include "nodes/geometry/rotation.hpp"
#include "nodes/layouts/color_beside.hpp"
#include "nodes/layouts/models_info.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TrueObject read_object(const json& info) {
  TrueObject object;
  object.diameter = info.at("diameter").get<double>() * kMetresPerUnit;
  if (!(object.diameter > 0)) throw std::invalid_argument("diameter must be > 0");
  const std::string axes[3] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    object.center[axis] = (info.at("min_" + axes[axis]).get<double>() +
                           info.at("size_" + axes[axis]).get<double>() / 2) *
                          kMetresPerUnit;
  object.symmetries = read_symmetries(info);
  object.axes = read_axes(info);
  return object;
}

TrueInstance read_instance(const json& entry) {
  const std::vector<double> r = numbers(entry.at("cam_R_m2c"), 9, "cam_R_m2c");
  TrueInstance instance;
  instance.obj_id = whole(entry, "obj_id");
  instance.T_scene_model =
      geometry::make_pose({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]},
                          metres(entry.at("cam_t_m2c"), "cam_t_m2c"));
  return instance;
}

Camera read_camera(const json& entry) {
  const std::vector<double> k = numbers(entry.at("cam_K"), 9, "cam_K");
  const Camera camera{k[0], k[4], k[2], k[5], entry.value("depth_scale", 1.0)};
  if (!(camera.fx > 0) || !(camera.fy > 0) || !(camera.depth_scale > 0))
    throw std::invalid_argument("cam_K and depth_scale must be > 0");
  return camera;
}

/// Entries by image number ("10" follows "9").
std::map<int, json> by_image(const ImageFolders& names, const fs::path& file) {
  std::map<int, json> images;
  const json root = names.read(file);
  for (const auto& item : root.items()) {
    const int im_id = number_of(item.key());
    if (im_id < 0) fail(file, formats::shown(item.key()) + " is no image number");
    if (!images.emplace(im_id, item.value()).second)
      fail(file, "image " + std::to_string(im_id) + " is given twice");
  }
  return images;
}

void add_once(std::map<int, fs::path>& entries, int number, const fs::path& entry,
              const std::string& kind) {
  const auto [first, is_new] = entries.emplace(number, entry);
  if (!is_new)
    fail(entry, "is " + kind + " " + std::to_string(number) + ", as is " + first->second.string());
}

std::map<int, fs::path> scene_folders(const fs::path& root) {
  std::map<int, fs::path> folders;
  for (const fs::path& entry : entries_of(root)) {
    const int scene_id = number_of(entry.filename().string());
    if (scene_id >= 0 && fs::is_directory(entry)) add_once(folders, scene_id, entry, "scene");
  }
  return folders;
}

std::map<int, fs::path> depth_images(const fs::path& scene) {
  std::map<int, fs::path> images;
  for (const fs::path& entry : entries_of(scene / "depth")) {
    const int im_id = number_of(entry.stem().string());
    if (im_id >= 0 && entry.extension() == ".png") add_once(images, im_id, entry, "image");
  }
  return images;
}

std::string image_name(int im_id) { return "image " + std::to_string(im_id); }

/// The visible fractions of an image's instances, as many as there are instances.
std::vector<double> read_visible(const std::map<int, json>& infos, const fs::path& file, int im_id,
                                 std::size_t count) {
  const auto image = infos.find(im_id);
  const std::size_t given = image == infos.end() ? 0 : image->second.size();
  if (given != count)
    fail(file, image_name(im_id) + " has " + std::to_string(given) +
                   " instances, the file of poses " + std::to_string(count));
  return located(file, image_name(im_id), [&] {
    std::vector<double> visible;
    for (const json& info : image->second) visible.push_back(info.at("visib_fract").get<double>());
    return visible;
  });
}

void read_images(const ImageFolders& names, const fs::path& scene, int scene_id,
                 GroundTruth& truth) {
  const std::map<int, fs::path> depth = depth_images(scene);
  const fs::path camera_file = scene / names.cameras;
  if (!fs::exists(camera_file)) {
    if (!depth.empty()) fail(camera_file, "is missing: the depth images have no camera");
    return;
  }
  for (const auto& [im_id, entry] : by_image(names, camera_file)) {
    const auto image = truth.images.find({scene_id, im_id});
    if (image == truth.images.end()) continue;
    image->second.camera = located(camera_file, image_name(im_id),
                                   [&, &values = entry] { return read_camera(values); });
  }
  for (const auto& [im_id, path] : depth) {
    const auto image = truth.images.find({scene_id, im_id});
    if (image == truth.images.end())
      truth.left_out.emplace(scene_id, im_id);
    else if (image->second.camera)
      image->second.depth = path;
    else
      fail(camera_file, "has no camera of " + image_name(im_id) + ", whose poses and depth exist");
  }
}

void read_scene(const ImageFolders& names, const fs::path& scene, int scene_id,
                GroundTruth& truth) {
  const fs::path gt_file = scene / names.poses;
  const fs::path info_file = names.visibility ? scene / names.visibility : fs::path();
  const bool has_info = names.visibility && fs::exists(info_file);
  const std::map<int, json> infos = has_info ? by_image(names, info_file) : std::map<int, json>();
  for (const auto& [im_id, entries] : by_image(names, gt_file)) {
    truth.images[{scene_id, im_id}];
    std::vector<double> visible;
    if (has_info) visible = read_visible(infos, info_file, im_id, entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
      TrueInstance instance =
          located(gt_file, image_name(im_id) + ", instance " + std::to_string(i),
                  [&, &list = entries] { return read_instance(list.at(i)); });
      instance.scene_id = scene_id;
      instance.im_id = im_id;
      if (has_info) instance.visible = visible[i];
      truth.instances.push_back(instance);
    }
  }
  read_images(names, scene, scene_id, truth);
}

void read_objects(const ImageFolders& names, const fs::path& folder, GroundTruth& truth) {
  const fs::path file = folder / names.models_info;
  const json infos = names.read(file);
  for (const auto& item : infos.items()) {
    const int obj_id = number_of(item.key());
    if (obj_id < 0) fail(file, formats::shown(item.key()) + " is no obj_id");
    truth.objects[obj_id] =
        located(file, "object " + item.key(), [&] { return read_object(item.value()); });
  }
  for (const TrueInstance& instance : truth.instances)
    if (!truth.objects.contains(instance.obj_id))
      fail(file, "has no object " + std::to_string(instance.obj_id) + ", which scene " +
                     std::to_string(instance.scene_id) + " holds");
}

bool has_scene_files(const ImageFolders& names, const fs::path& dataset, const std::string& split) {
  for (const fs::path& entry : entries_of(dataset / split))
    if (number_of(entry.filename().string()) >= 0 &&
        (fs::exists(entry / names.poses) || fs::exists(entry / names.cameras)))
      return true;
  return false;
}

std::vector<SceneFile> images_of(const ImageFolders& names, const fs::path& scene, int scene_id) {
  const fs::path camera_file = scene / names.cameras;
  const std::map<int, json> cameras = by_image(names, camera_file);
  std::vector<SceneFile> images;
  for (const auto& [im_id, path] : depth_images(scene)) {
    const auto entry = cameras.find(im_id);
    if (entry == cameras.end()) fail(camera_file, image_name(im_id) + ": has no camera");
    const Camera camera =
        located(camera_file, image_name(im_id), [&] { return read_camera(entry->second); });
    images.push_back({path, scene_id, im_id, camera, {}, {}, color_beside(path)});
  }
  return images;
}

std::vector<SceneFile> list_images(const ImageFolders& names, const fs::path& dataset,
                                   const std::string& split) {
  if (!fs::is_directory(dataset / split)) fail(dataset / split, "no such folder");
  std::vector<SceneFile> scenes;
  for (const auto& [scene_id, folder] : scene_folders(dataset / split)) {
    std::vector<SceneFile> images = images_of(names, folder, scene_id);
    scenes.insert(scenes.end(), images.begin(), images.end());
  }
  if (scenes.empty()) fail(dataset / split, "no depth image, expected SCENE/depth/IMAGE.png in it");
  return scenes;
}

std::vector<fs::path> list_model_files(const fs::path& dataset) {
  const fs::path folder = dataset / "models";
  std::vector<fs::path> files;
  for (const fs::path& entry : entries_of(folder))
    if (entry.extension() == ".ply") files.push_back(entry);
  if (files.empty()) fail(folder, "no model in it, expected obj_NNNNNN.ply");
  return files;
}

GroundTruth read_truth(const ImageFolders& names, const fs::path& dataset,
                       const std::string& split) {
  const fs::path root = dataset / split;
  if (!fs::is_directory(root)) fail(root, "no such folder");
  GroundTruth truth;
  for (const auto& [scene_id, folder] : scene_folders(root))
    read_scene(names, folder, scene_id, truth);
  if (truth.instances.empty())
    fail(root, std::string("no true pose in it, expected SCENE/") + names.poses);
  read_objects(names, dataset / "models", truth);
  return truth;
}

}  // namespace

Layout layout_of(const ImageFolders& names, const std::string& name, const std::string& expected) {
  Layout layout{name, expected, {}, {}, list_model_files, {}};
  layout.recognises = [names](const fs::path& dataset, const std::string& split) {
    return has_scene_files(names, dataset, split) ||
           fs::exists(dataset / "models" / names.models_info);
  };
  layout.scenes = [names](const fs::path& dataset, const std::string& split) {
    return list_images(names, dataset, split);
  };
  layout.truth = [names](const fs::path& dataset, const std::string& split) {
    return read_truth(names, dataset, split);
  };
  return layout;
}

Recording scene_of(const ImageFolders& names, const std::string& name) {
  return {name, std::string("depth/ and ") + names.cameras,
          [names](const fs::path& folder) {
            return fs::exists(folder / names.cameras) && fs::is_directory(folder / "depth");
          },
          [names](const fs::path& folder) { return images_of(names, folder, 0); }};
}

}  // namespace posevote::layouts
