// SPDX-License-Identifier: BSD-3-Clause
// Mian's UWA set, and Queen's, which is laid out like it: models *.ply, scenes rsN.ply, poses
// OBJECT-rsN.xf (4 x 4 numbers row by row), lengths in mm; in one folder, or in models/, scenes/
// and ground_truth/. occlusion.txt, where present: `scene object percent`. There are no splits.
//
// The names of files, objects and the occlusion table differ in case, dashes and endings
// ("T-rex_high.ply", "T-rex-rs1.xf", "trex"): letters and digits decide, and one name may be the
// beginning of the other. Poses of an object without a model (the set's rhino) are left out.
#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

#include "nodes/geometry/rotation.hpp"
#include "nodes/layouts/files.hpp"
#include "nodes/layouts/layout.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;

/// N of "rsN", or -1.
int scene_number(const std::string& stem) {
  return stem.starts_with("rs") ? number_of(stem.substr(2)) : -1;
}

/// The files of a kind in the folder of that name, or else in the data set's own.
std::vector<fs::path> files_of(const fs::path& folder, const char* kind, const char* extension) {
  std::vector<fs::path> files;
  const fs::path own = folder / kind;
  for (const fs::path& entry : entries_of(fs::is_directory(own) ? own : folder))
    if (entry.extension() == extension) files.push_back(entry);
  return files;
}

std::vector<fs::path> scene_files(const fs::path& folder) {
  std::vector<fs::path> files = files_of(folder, "scenes", ".ply");
  std::erase_if(files, [](const fs::path& f) { return scene_number(f.stem().string()) < 0; });
  return files;
}

std::vector<fs::path> models(const fs::path& folder) {
  std::vector<fs::path> files = files_of(folder, "models", ".ply");
  std::erase_if(files, [](const fs::path& f) { return scene_number(f.stem().string()) >= 0; });
  if (files.empty()) fail(folder, "no model (*.ply) in it or in its folder models/");
  return files;
}

bool recognises(const fs::path& folder, const std::string&) {
  return !scene_files(folder).empty() || !files_of(folder, "ground_truth", ".xf").empty();
}

/// Numbered by the sort by path, as `run --scenes` does it.
std::vector<SceneFile> scenes(const fs::path& folder, const std::string&) {
  std::vector<SceneFile> list;
  for (const fs::path& file : scene_files(folder))
    list.push_back({file, 0, static_cast<int>(list.size()), std::nullopt});
  if (list.empty()) fail(folder, "no scene (rsN.ply) in it or in its folder scenes/");
  return list;
}

std::string plain(const std::string& name) {
  std::string letters;
  for (const unsigned char c : name)
    if (std::isalnum(c)) letters += static_cast<char>(std::tolower(c));
  return letters;
}

bool alike(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() && (a.starts_with(b) || b.starts_with(a));
}

/// obj_id of the model that a name means, if there is one.
std::optional<int> find_object(const std::map<int, TrueObject>& objects, const std::string& name,
                               const fs::path& file) {
  std::vector<int> near;
  for (const auto& [obj_id, object] : objects) {
    if (plain(object.name) == plain(name)) return obj_id;
    if (alike(plain(object.name), plain(name))) near.push_back(obj_id);
  }
  if (near.size() > 1) fail(file, "'" + name + "' may be one of several models");
  return near.empty() ? std::nullopt : std::optional(near.front());
}

Eigen::Isometry3d read_xf(const fs::path& file) {
  std::ifstream stream(file);
  double m[16];
  for (int i = 0; i < 16; ++i)
    if (!(stream >> m[i]))
      fail(file, "expected 16 numbers, number " + std::to_string(i + 1) + " is none");
  std::string rest;
  if (stream >> rest) fail(file, "expected 16 numbers, then comes '" + rest + "'");
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
    fail(file, "the last row is not 0 0 0 1");
  try {
    return geometry::make_pose({m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]},
                               Eigen::Vector3d(m[3], m[7], m[11]) * 0.001);
  } catch (const std::invalid_argument& error) {
    fail(file, error.what());
  }
}

using Visible = std::map<std::pair<int, int>, double>;  ///< by N of rsN, obj_id

Visible read_occlusion(const fs::path& folder, const std::map<int, TrueObject>& objects) {
  fs::path file = folder / "occlusion.txt";
  if (!fs::exists(file)) file = folder / "ground_truth" / "occlusion.txt";
  Visible visible;
  std::ifstream stream(file);
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    std::istringstream line(text);
    int scene = 0;
    std::string name;
    double percent = 0;
    if (!(line >> scene)) continue;  // the heading, an empty line
    if (!(line >> name >> percent) || !(percent >= 0 && percent <= 100))
      fail(file, "line " + std::to_string(number) + ": expected scene, object, 0..100 %");
    if (const auto obj_id = find_object(objects, name, file))
      visible[{scene, *obj_id}] = 1 - percent / 100;
  }
  return visible;
}

struct PoseName {
  std::string object;
  int scene = -1;
};

/// Nothing of another name: the published archive holds a `parasaurolophus-rs6-old.xf`.
std::optional<PoseName> split_name(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t dash = stem.rfind('-');
  if (dash == std::string::npos || scene_number(stem.substr(dash + 1)) < 0) return std::nullopt;
  return PoseName{stem.substr(0, dash), scene_number(stem.substr(dash + 1))};
}

void read_poses(const fs::path& folder, const std::map<int, int>& im_ids, const Visible& visible,
                GroundTruth& truth) {
  std::map<std::string, int> without_model;
  for (const fs::path& file : files_of(folder, "ground_truth", ".xf")) {
    const std::optional<PoseName> name = split_name(file);
    if (!name) {
      truth.notes.push_back(file.filename().string() +
                            ": left out, expected a name like OBJECT-rsN.xf");
      continue;
    }
    const auto image = im_ids.find(name->scene);
    if (image == im_ids.end())
      fail(file, "there is no scene rs" + std::to_string(name->scene) + ".ply");
    const auto obj_id = find_object(truth.objects, name->object, file);
    truth.images[{0, image->second}];
    if (!obj_id) {
      ++without_model[name->object];
      continue;
    }
    TrueInstance instance{0, image->second, *obj_id, read_xf(file), std::nullopt};
    const auto seen = visible.find({name->scene, *obj_id});
    if (seen != visible.end()) instance.visible = seen->second;
    truth.instances.push_back(instance);
  }
  for (const auto& [object, count] : without_model)
    truth.notes.push_back(object + ": no model of it, " + std::to_string(count) +
                          " poses left out");
}

GroundTruth truth(const fs::path& folder, const std::string& split) {
  GroundTruth truth;
  for (const auto& [obj_id, file] : number_models(models(folder))) {
    truth.objects[obj_id].name = file.stem().string();
    truth.objects[obj_id].symmetries = {Eigen::Isometry3d::Identity()};
  }
  std::map<int, int> im_ids;  // by N of rsN
  for (const SceneFile& scene : scenes(folder, split))
    im_ids[scene_number(scene.path.stem().string())] = scene.im_id;
  read_poses(folder, im_ids, read_occlusion(folder, truth.objects), truth);
  if (truth.instances.empty()) fail(folder, "no true pose, expected OBJECT-rsN.xf");
  std::stable_sort(truth.instances.begin(), truth.instances.end(),
                   [](const auto& a, const auto& b) { return a.im_id < b.im_id; });
  for (const auto& [number, im_id] : im_ids) {
    if (truth.images.contains({0, im_id})) continue;
    truth.left_out.emplace(0, im_id);
    truth.notes.push_back("rs" + std::to_string(number) + ".ply: has no poses, not judged");
  }
  return truth;
}

const auto registered =
    register_layout({"UWA or Queen's",
                     "*.ply models, rsN.ply scenes and OBJECT-rsN.xf poses, in one "
                     "folder or in models/, scenes/, ground_truth/",
                     recognises, scenes, models, truth});

}  // namespace
}  // namespace posevote::layouts
