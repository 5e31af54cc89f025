// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/inputs.hpp"

#include <glob.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "nodes/formats/format.hpp"
#include "nodes/layouts/camera_file.hpp"
#include "nodes/layouts/files.hpp"
#include "nodes/layouts/layout.hpp"
#include "nodes/layouts/models_info.hpp"
#include "nodes/layouts/recording.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// Numbers of one width, so that they compare by value.
std::string padded(const std::string& text) {
  constexpr std::size_t kWidth = 20;
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
    if (end == at) {
      out += text[at++];
      continue;
    }
    const std::size_t first = std::min(text.find_first_not_of('0', at), end);
    out.append(kWidth - std::min(kWidth, end - first), '0').append(text, first, end - first);
    at = end;
  }
  return out;
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
std::vector<fs::path> expand(const std::string& argument, formats::Wanted wanted) {
  std::vector<fs::path> paths;
  if (fs::is_directory(argument)) {
    for (const auto& entry : fs::directory_iterator(argument))
      if (!entry.is_directory() && formats::has_ending(entry.path(), wanted))
        paths.push_back(entry.path());
    if (paths.empty())
      throw std::invalid_argument(argument + ": no " + formats::list_endings(wanted) +
                                  " file in it");
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

/// The scans of a folder of depth images with their cameras, of another folder, a file or a glob.
std::vector<SceneFile> expand_scans(const std::string& argument) {
  const layouts::Recording* recording =
      fs::is_directory(argument) ? layouts::find_recording(argument) : nullptr;
  if (recording) return recording->frames(argument);
  std::vector<SceneFile> files;
  for (fs::path& path : expand(argument, formats::Wanted::kAny)) {
    const bool image = formats::has_ending(path, formats::Wanted::kDepthImages);
    const auto camera = image ? layouts::camera_beside(path) : std::nullopt;
    files.push_back({std::move(path), 0, 0, camera});
  }
  return files;
}

/// As people count: scan2 before scan10.
bool in_natural_order(const fs::path& a, const fs::path& b) {
  const std::string left = a.string(), right = b.string();
  return std::pair(padded(left), left) < std::pair(padded(right), right);
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
  std::vector<SceneFile> files;
  for (const std::string& argument : arguments)
    for (SceneFile& file : as_arguments([&] { return expand_scans(argument); }))
      files.push_back(std::move(file));
  std::stable_sort(files.begin(), files.end(), [](const SceneFile& a, const SceneFile& b) {
    return in_natural_order(a.path, b.path);
  });
  const auto same = [](const SceneFile& a, const SceneFile& b) { return a.path == b.path; };
  files.erase(std::unique(files.begin(), files.end(), same), files.end());
  std::vector<SceneEntry> scenes;
  for (SceneFile& file : files) {
    const std::size_t number = scenes.size();
    file.im_id = static_cast<int>(number);
    scenes.push_back({number, "", std::move(file)});
  }
  name_scenes(scenes);
  return scenes;
}

std::vector<SceneEntry> list_dataset_scenes(const std::string& dataset, const std::string& split) {
  std::vector<SceneEntry> scenes;
  for (SceneFile& file :
       as_arguments([&] { return layouts::find_layout(dataset, split).scenes(dataset, split); })) {
    const bool image = file.camera.has_value();
    const std::string folder =
        image ? file.path.parent_path().parent_path().filename().string() + "_" : "";
    const std::string name = folder + file.path.stem().string();
    scenes.push_back({scenes.size(), name, std::move(file)});
  }
  return scenes;
}

std::vector<std::string> list_dataset_models(const std::string& dataset, const std::string& split) {
  std::vector<std::string> files;
  for (const fs::path& file :
       as_arguments([&] { return layouts::find_layout(dataset, split).models(dataset); }))
    files.push_back(file.string());
  return files;
}

ModelFiles list_models(const std::vector<std::string>& arguments) {
  std::vector<fs::path> files;
  for (const std::string& argument : arguments)
    for (const fs::path& path : expand(argument, formats::Wanted::kMeshes)) {
      if (!fs::is_regular_file(path))
        throw std::invalid_argument(path.string() + ": no such model file");
      files.push_back(path);
    }
  ModelFiles models;
  std::map<fs::path, std::map<int, Symmetries>> known;  // by models_info.json
  for (const auto& [obj_id, path] : as_arguments([&] { return layouts::number_models(files); })) {
    models.push_back({path, obj_id, path.stem().string()});
    const fs::path info = path.parent_path() / "models_info.json";
    const auto [beside, is_new] = known.try_emplace(info);
    if (is_new) beside->second = as_arguments([&] { return layouts::known_symmetries(info); });
    const auto said = beside->second.find(obj_id);
    if (said != beside->second.end()) models.back().symmetries = said->second;
  }
  return models;
}

std::vector<SceneEntry> take_shard(std::vector<SceneEntry> scenes, const std::string& shard) {
  if (shard.empty()) return scenes;
  const std::size_t slash = shard.find('/');
  const int part = layouts::number_of(shard.substr(0, slash));
  const int parts = slash == std::string::npos ? -1 : layouts::number_of(shard.substr(slash + 1));
  if (part < 1 || parts < part)
    throw std::invalid_argument("--shard " + shard + ": expected I/N with 1 <= I <= N");
  std::erase_if(scenes, [&](const SceneEntry& scene) {
    return scene.number % std::size_t(parts) != std::size_t(part - 1);
  });
  return scenes;
}

}  // namespace posevote
