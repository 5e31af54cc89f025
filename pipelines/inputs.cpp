// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/inputs.hpp"

#include <glob.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
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

std::vector<fs::path> expand_glob(const std::string& pattern) {
  glob_t found{};
  std::vector<fs::path> paths;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i) paths.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  return paths;
}

/// Whether a file is one of those that lie beside scans and models without being one.
bool is_side_file(const fs::path& file, formats::Wanted wanted) {
  static const std::set<std::string> known{"",      ".json", ".xf",   ".pose", ".txt",
                                           ".csv",  ".yaml", ".yml",  ".md",   ".mtl",
                                           ".html", ".log",  ".part", ".tmp"};
  static const std::set<std::string> textures{".png", ".jpg", ".jpeg", ".bmp", ".tga"};
  const std::string ending = file.extension().string();
  return known.contains(ending) || file.filename().string().starts_with('.') ||
         (wanted == formats::Wanted::kMeshes && textures.contains(ending));
}

/// "3 files .tiff, 1 file .xyz"; "" where nothing is passed over.
std::string passed_over(const std::map<std::string, std::size_t>& endings) {
  std::string text;
  for (const auto& [ending, count] : endings)
    text += (text.empty() ? "" : ", ") + std::to_string(count) +
            (count == 1 ? " file " : " files ") + ending;
  return text;
}

/// What no loader knows is told, once for each ending.
std::vector<fs::path> files_in(const fs::path& folder, formats::Wanted wanted) {
  std::vector<fs::path> paths;
  std::map<std::string, std::size_t> unknown;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::error_code is_loop;  // of links: for the frame to fail on
    if (entry.is_directory(is_loop)) continue;
    if (formats::has_ending(entry.path(), wanted))
      paths.push_back(entry.path());
    else if (!is_side_file(entry.path(), wanted))
      ++unknown[entry.path().extension().string()];
  }
  const std::string readable = formats::list_endings(wanted);
  if (paths.empty())
    throw std::invalid_argument(folder.string() + ": no " + readable + " file in it" +
                                (unknown.empty() ? "" : ", but " + passed_over(unknown)));
  if (!unknown.empty())
    spdlog::warn("{}: {} passed over; {} files are read", folder.string(), passed_over(unknown),
                 readable);
  return paths;
}

/// A file stays as it is, even if it cannot be opened: that is for the frame to fail on.
std::vector<fs::path> expand(const std::string& argument, formats::Wanted wanted) {
  std::vector<fs::path> paths;
  std::error_code problem;
  if (fs::is_directory(argument, problem)) {
    paths = files_in(argument, wanted);
  } else if (fs::exists(fs::symlink_status(argument, problem))) {
    paths.emplace_back(argument);
  } else {
    paths = expand_glob(argument);
    if (paths.empty())
      throw std::invalid_argument(argument + ": no such file, folder or glob match");
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Of a file of many images in a folder or of a glob. One that cannot be read stays as it is, for its
/// frame to fail on, and the others go on.
std::vector<SceneFile> frames_among_others(const fs::path& file) try {
  if (const auto* recording = layouts::find_recording(file)) return recording->frames(file);
  return {{file, 0, 0, std::nullopt}};
} catch (const std::runtime_error& error) {
  spdlog::warn("{}", error.what());
  return {{file, 0, 0, std::nullopt}};
}

/// The scans of a recording with their cameras, of a folder, a file or a glob.
std::vector<SceneFile> expand_scans(const std::string& argument) {
  if (const auto* recording = layouts::find_recording(argument)) return recording->frames(argument);
  std::vector<SceneFile> files;
  for (fs::path& path : expand(argument, formats::Wanted::kAny)) {
    if (!formats::container_of(path).empty()) {
      for (SceneFile& frame : frames_among_others(path)) files.push_back(std::move(frame));
      continue;
    }
    const bool image = formats::has_ending(path, formats::Wanted::kDepthImages);
    const auto camera = image ? layouts::camera_beside(path) : std::nullopt;
    files.push_back({std::move(path), 0, 0, camera});
  }
  return files;
}

/// Names after the file, with the number in front where two would share a name: of a.off, a.pcd and
/// 000001_a.ply all three.
void name_scenes(std::vector<SceneEntry>& scenes) {
  for (SceneEntry& scene : scenes) scene.name = scene.file.path.stem().string();
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::string, int> uses;
    for (const SceneEntry& scene : scenes) ++uses[scene.name];
    for (SceneEntry& scene : scenes) {
      const std::string stem = scene.file.path.stem().string();
      if (uses[scene.name] == 1 || scene.name != stem) continue;
      char number[32];
      std::snprintf(number, sizeof number, "%06zu_", scene.number);
      scene.name = number + stem;
      changed = true;
    }
  }
}

}  // namespace

std::vector<SceneEntry> list_scenes(const std::vector<std::string>& arguments) {
  std::vector<SceneFile> files;
  for (const std::string& argument : arguments)
    for (SceneFile& file : as_arguments([&] { return expand_scans(argument); }))
      files.push_back(std::move(file));
  std::stable_sort(files.begin(), files.end(), [](const SceneFile& a, const SceneFile& b) {
    return layouts::in_natural_order(a.path.string(), b.path.string());
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
      std::error_code problem;
      if (!fs::is_regular_file(path, problem))
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
