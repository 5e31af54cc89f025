// SPDX-License-Identifier: BSD-3-Clause
#include "tools/init/camera_beside.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <exception>
#include <vector>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/sensor_pose.hpp"

namespace posevote::init {
namespace {

namespace fs = std::filesystem;

bool is_camera(const Camera& camera) {
  return camera.fx > 1 && camera.fy > 1 && camera.cx > 1 && camera.cy > 1;
}

/// Of a 3 x 3 matrix row by row, or column by column as Open3D has it.
std::optional<Camera> of_matrix(const std::vector<double>& k) {
  if (k.size() != 9) return std::nullopt;
  const bool by_columns = k[2] == 0 && k[6] != 0;
  const Camera camera{k[0], k[4], by_columns ? k[6] : k[2], by_columns ? k[7] : k[5], 1};
  return is_camera(camera) ? std::optional(camera) : std::nullopt;
}

std::vector<double> numbers_of(const YAML::Node& node) {
  std::vector<double> numbers;
  const YAML::Node list = node.IsMap() && node["data"] ? node["data"] : node;
  if (!list.IsSequence()) return {};
  for (const YAML::Node& item : list)
    if (item.IsSequence())
      for (const YAML::Node& inner : item) numbers.push_back(inner.as<double>());
    else
      numbers.push_back(item.as<double>());
  return numbers;
}

std::optional<Camera> of_map(const YAML::Node& map) {
  std::optional<Camera> camera;
  for (const char* key : {"cam_K", "camera_matrix", "K", "k", "intrinsic_matrix"})
    if (!camera && map[key]) camera = of_matrix(numbers_of(map[key]));
  const auto value = [&map](const char* name, const char* other) {
    const YAML::Node node = map[name] ? map[name] : map[other];
    return node ? node.as<double>() : 0;
  };
  const Camera plain{value("fx", "fx"), value("fy", "fy"), value("cx", "ppx"), value("cy", "ppy"),
                     1};
  if (!camera && is_camera(plain)) camera = plain;
  if (camera && map["depth_scale"]) camera->depth_scale = map["depth_scale"].as<double>();
  return camera;
}

/// In the map itself, or a few levels below; `first`: the key to look under before all others.
std::optional<Camera> search(const YAML::Node& node, const std::string& first, int levels) {
  if (!node.IsMap() || levels == 0) return std::nullopt;
  if (const auto camera = of_map(node)) return camera;
  if (node[first])
    if (const auto camera = search(node[first], first, levels - 1)) return camera;
  for (const auto& entry : node)
    if (const auto camera = search(entry.second, first, levels - 1)) return camera;
  return std::nullopt;
}

std::optional<Camera> read_camera(const fs::path& file, const std::string& image) {
  constexpr std::uintmax_t kMostBytes = 1 << 20;
  constexpr int kLevels = 4;
  const std::string ending = file.extension().string(), name = file.stem().string();
  try {
    if (!fs::is_regular_file(file) || fs::file_size(file) > kMostBytes) return std::nullopt;
    if (ending == ".json" || ending == ".yaml" || ending == ".yml")
      return search(YAML::LoadFile(file.string()), image, kLevels);
    const bool names_it =
        name.find("intrinsic") != std::string::npos || name.find("camera") != std::string::npos;
    if (ending == ".txt" && names_it)
      return of_matrix(formats::read_pose_numbers(formats::read_file(file).view()));
  } catch (const std::exception&) {  // is something else
  }
  return std::nullopt;
}

/// "12" of 000012.png, which is what BOP calls the image.
std::string number_of(const fs::path& image) {
  const std::string stem = image.stem().string();
  const std::size_t first = stem.find_first_not_of('0');
  return first == std::string::npos ? "0" : stem.substr(first);
}

}  // namespace

std::optional<FoundCamera> camera_beside(const fs::path& image) {
  const fs::path folder = fs::absolute(image).parent_path();
  for (const fs::path& place : {folder, folder.parent_path()}) {
    std::error_code ignored;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(place, ignored)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      if (const auto camera = read_camera(file, number_of(image)))
        return FoundCamera{*camera, file};
  }
  return std::nullopt;
}

}  // namespace posevote::init
