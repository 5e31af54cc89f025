// SPDX-License-Identifier: BSD-3-Clause
// Example of a layout: a folder with scans/*.ply, models/*.ply and poses.txt, whose lines hold the
// scan's number, obj_id and the 12 numbers of T_scene_model's upper rows, in mm. Copied to
// nodes/layouts/flat_folder.cpp, namespace posevote::layouts, `run --dataset` and `evaluate` know
// it.
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "nodes/layouts/files.hpp"
#include "nodes/layouts/layout.hpp"

namespace posevote::examples {
namespace {

namespace fs = std::filesystem;
using layouts::GroundTruth, layouts::TrueInstance;

bool recognises(const fs::path& folder, const std::string&) {
  return fs::is_directory(folder / "scans") && fs::exists(folder / "poses.txt");
}

std::vector<SceneFile> scenes(const fs::path& folder, const std::string&) {
  std::vector<SceneFile> files;
  for (const fs::path& path : layouts::entries_of(folder / "scans"))
    files.push_back({path, 0, static_cast<int>(files.size()), std::nullopt});
  return files;
}

std::vector<fs::path> models(const fs::path& folder) {
  return layouts::entries_of(folder / "models");
}

TrueInstance read_pose(const std::string& line, const std::string& where) {
  std::istringstream stream(line);
  TrueInstance instance;
  stream >> instance.im_id >> instance.obj_id;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      stream >> instance.T_scene_model.matrix()(row, column);
  if (!stream) throw std::runtime_error(where + ": expected a scan, an obj_id and 12 numbers");
  instance.T_scene_model.translation() *= 0.001;
  return instance;
}

GroundTruth truth(const fs::path& folder, const std::string& split) {
  GroundTruth truth;
  for (const SceneFile& scene : scenes(folder, split)) truth.images[{0, scene.im_id}] = {};
  for (const auto& [obj_id, model] : layouts::number_models(models(folder))) {
    truth.objects[obj_id].name = model.stem().string();
    truth.objects[obj_id].symmetries = {Eigen::Isometry3d::Identity()};  // turned by nothing
  }
  std::ifstream file(folder / "poses.txt");
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
    truth.instances.push_back(
        read_pose(line, (folder / "poses.txt").string() + ":" + std::to_string(number)));
  return truth;
}

const auto registered = layouts::register_layout(
    {"flat folder", "scans/*.ply, models/*.ply, poses.txt", recognises, scenes, models, truth});

}  // namespace
}  // namespace posevote::examples
