// SPDX-License-Identifier: BSD-3-Clause
#include "tools/inputs.hpp"

#include <glob.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace posevote {
namespace {

namespace fs = std::filesystem;

bool has_known_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::set<std::string> known{".ply", ".pcd", ".obj", ".stl", ".off", ".png"};
  return known.contains(ending);
}

std::vector<fs::path> expand_glob(const std::string& pattern) {
  glob_t found{};
  std::vector<fs::path> paths;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i) paths.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  return paths;
}

/// A file stays as it is, even if it cannot be opened: that is for the frame to fail on.
std::vector<fs::path> expand(const std::string& argument) {
  std::vector<fs::path> paths;
  if (fs::is_directory(argument)) {
    for (const auto& entry : fs::directory_iterator(argument))
      if (!entry.is_directory() && has_known_ending(entry.path())) paths.push_back(entry.path());
    if (paths.empty())
      throw std::invalid_argument(argument + ": no ply, pcd, obj, stl, off or png file in it");
  } else if (fs::exists(fs::symlink_status(argument))) {
    paths.emplace_back(argument);
  } else {
    paths = expand_glob(argument);
    if (paths.empty())
      throw std::invalid_argument(argument + ": no such file, folder or glob match");
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

int number_of(const std::string& digits) {
  int value = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc() && end == digits.data() + digits.size() ? value : -1;
}

std::vector<fs::path> sorted_entries(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw std::invalid_argument(folder.string() + ": no such folder");
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

nlohmann::json read_json(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::invalid_argument(file.string() + ": cannot be read");
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(file.string() + ": " + error.what());
  }
}

Camera read_camera(const nlohmann::json& cameras, const fs::path& file, int im_id) {
  const std::string key = std::to_string(im_id);
  try {
    const nlohmann::json& entry = cameras.at(key);
    const auto k = entry.at("cam_K").get<std::vector<double>>();
    return {k.at(0), k.at(4), k.at(2), k.at(5), entry.value("depth_scale", 1.0)};
  } catch (const std::exception& error) {
    throw std::invalid_argument(file.string() + ": image " + key +
                                ": expected cam_K of 9 numbers (" + error.what() + ")");
  }
}

/// Names after the file, with the number in front where two files share a name.
void name_scenes(std::vector<SceneEntry>& scenes) {
  std::map<std::string, int> uses;
  for (const SceneEntry& scene : scenes) ++uses[scene.file.path.stem().string()];
  for (SceneEntry& scene : scenes) {
    const std::string stem = scene.file.path.stem().string();
    char number[32];
    std::snprintf(number, sizeof number, "%06zu_", scene.number);
    scene.name = (uses[stem] > 1 ? number : "") + stem;
  }
}

}  // namespace

std::vector<SceneEntry> list_scenes(const std::vector<std::string>& arguments) {
  std::vector<fs::path> paths;
  for (const std::string& argument : arguments)
    for (fs::path& path : expand(argument)) paths.push_back(std::move(path));
  std::sort(paths.begin(), paths.end());
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  std::vector<SceneEntry> scenes;
  for (const fs::path& path : paths) {
    const std::size_t number = scenes.size();
    scenes.push_back({number, "", {path, 0, static_cast<int>(number), std::nullopt}});
  }
  name_scenes(scenes);
  return scenes;
}

std::vector<SceneEntry> list_bop_scenes(const std::string& dataset, const std::string& split) {
  std::vector<SceneEntry> scenes;
  for (const fs::path& folder : sorted_entries(fs::path(dataset) / split)) {
    const int scene_id = number_of(folder.filename().string());
    if (scene_id < 0 || !fs::is_directory(folder)) continue;
    const fs::path camera_file = folder / "scene_camera.json";
    const nlohmann::json cameras = read_json(camera_file);
    for (const fs::path& image : sorted_entries(folder / "depth")) {
      const int im_id = number_of(image.stem().string());
      if (im_id < 0) continue;
      scenes.push_back({scenes.size(),
                        folder.filename().string() + "_" + image.stem().string(),
                        {image, scene_id, im_id, read_camera(cameras, camera_file, im_id)}});
    }
  }
  if (scenes.empty())
    throw std::invalid_argument(dataset + ": no depth image in " + split +
                                "/NNNNNN/depth, expected the layout of a BOP data set");
  return scenes;
}

ModelFiles list_models(const std::vector<std::string>& arguments) {
  ModelFiles models;
  std::map<int, fs::path> taken;
  for (const std::string& argument : arguments)
    for (const fs::path& path : expand(argument)) {
      if (!fs::is_regular_file(path))
        throw std::invalid_argument(path.string() + ": no such model file");
      const std::string stem = path.stem().string();
      const int named = stem.starts_with("obj_") ? number_of(stem.substr(4)) : -1;
      const int obj_id = named >= 0 ? named : static_cast<int>(models.size()) + 1;
      const auto [first, is_new] = taken.emplace(obj_id, path);
      if (!is_new)
        throw std::invalid_argument(path.string() + ": has obj_id " + std::to_string(obj_id) +
                                    ", as has " + first->second.string());
      models.push_back({path, obj_id, stem});
    }
  std::sort(models.begin(), models.end(),
            [](const ModelFile& a, const ModelFile& b) { return a.obj_id < b.obj_id; });
  return models;
}

std::vector<SceneEntry> take_shard(std::vector<SceneEntry> scenes, const std::string& shard) {
  if (shard.empty()) return scenes;
  const std::size_t slash = shard.find('/');
  const int part = number_of(shard.substr(0, slash));
  const int parts = slash == std::string::npos ? -1 : number_of(shard.substr(slash + 1));
  if (part < 1 || parts < part)
    throw std::invalid_argument("--shard " + shard + ": expected I/N with 1 <= I <= N");
  std::erase_if(scenes, [&](const SceneEntry& scene) {
    return scene.number % std::size_t(parts) != std::size_t(part - 1);
  });
  return scenes;
}

}  // namespace posevote
