// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/ground_truth.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "graph/schema.hpp"
#include "nodes/load/read_cloud.hpp"
#include "tools/evaluate/rotation.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMetresPerUnit = 0.001;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

json read_json(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) fail(file, "cannot be read: no such file?");
  json root = json::parse(stream, nullptr, false);
  if (!root.is_object()) fail(file, "is no JSON object");
  return root;
}

/// Runs `read`; what is wrong with the JSON's types or keys is reported with the place in the file.
template <class Read>
auto located(const fs::path& file, const std::string& place, const Read& read) {
  try {
    return read();
  } catch (const json::exception& error) {
    fail(file, place + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    fail(file, place + ": " + error.what());
  }
}

std::vector<double> numbers(const json& list, std::size_t count, const std::string& name) {
  const auto values = list.get<std::vector<double>>();
  if (values.size() != count)
    throw std::invalid_argument(name + " has " + std::to_string(values.size()) +
                                " numbers, expected " + std::to_string(count));
  return values;
}

int number_of(const std::string& text) {
  std::size_t digits = text.find_first_not_of('0');
  const std::string plain = digits == std::string::npos ? "0" : text.substr(digits);
  return text.empty() ? -1 : graph::Scalar<int>::parse(plain).value_or(-1);
}

Eigen::Isometry3d read_symmetry(const json& list) {
  const std::vector<double> m = numbers(list, 16, "symmetries_discrete");
  return make_pose({m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]},
                   Eigen::Vector3d(m[3], m[7], m[11]) * kMetresPerUnit);
}

TrueObject read_object(const json& info) {
  TrueObject object;
  object.diameter = info.at("diameter").get<double>() * kMetresPerUnit;
  if (!(object.diameter > 0)) throw std::invalid_argument("diameter must be > 0");
  const std::string axes[3] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    object.center[axis] = (info.at("min_" + axes[axis]).get<double>() +
                           info.at("size_" + axes[axis]).get<double>() / 2) *
                          kMetresPerUnit;
  object.symmetries = {Eigen::Isometry3d::Identity()};
  for (const json& matrix : info.value("symmetries_discrete", json::array()))
    object.symmetries.push_back(read_symmetry(matrix));
  for (const json& symmetry : info.value("symmetries_continuous", json::array())) {
    const std::vector<double> axis = numbers(symmetry.at("axis"), 3, "axis");
    object.axes.push_back(Eigen::Vector3d(axis[0], axis[1], axis[2]).normalized());
    if (!object.axes.back().allFinite() || object.axes.back().isZero())
      throw std::invalid_argument("the axis of a symmetry has no direction");
  }
  return object;
}

TrueInstance read_instance(const json& entry) {
  const std::vector<double> r = numbers(entry.at("cam_R_m2c"), 9, "cam_R_m2c");
  const std::vector<double> t = numbers(entry.at("cam_t_m2c"), 3, "cam_t_m2c");
  TrueInstance instance;
  instance.obj_id = entry.at("obj_id").get<int>();
  instance.T_scene_model = make_pose({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]},
                                     Eigen::Vector3d(t[0], t[1], t[2]) * kMetresPerUnit);
  return instance;
}

/// The visible fractions of an image's instances, as many as there are instances.
std::vector<double> read_visible(const json& infos, const fs::path& file, const std::string& im_id,
                                 std::size_t count) {
  const auto image = infos.find(im_id);
  const std::size_t given = image == infos.end() ? 0 : image->size();
  if (given != count)
    fail(file, "image " + im_id + " has " + std::to_string(given) + " instances, scene_gt.json " +
                   std::to_string(count));
  std::vector<double> visible;
  for (const json& info : *image) visible.push_back(info.at("visib_fract").get<double>());
  return visible;
}

void read_scene(const fs::path& folder, int scene_id, GroundTruth& truth) {
  const fs::path gt_file = folder / "scene_gt.json", info_file = folder / "scene_gt_info.json";
  const json gt = read_json(gt_file);
  const bool has_info = fs::exists(info_file);
  const json infos = has_info ? read_json(info_file) : json::object();
  std::map<int, std::string> images;  // by number: "10" follows "9"
  for (const auto& item : gt.items()) {
    const int im_id = number_of(item.key());
    if (im_id < 0) fail(gt_file, "'" + item.key() + "' is no image number");
    if (!images.emplace(im_id, item.key()).second)
      fail(gt_file, "image " + std::to_string(im_id) + " is given twice");
  }
  for (const auto& [im_id, key] : images) {
    truth.images.emplace(scene_id, im_id);
    const json& entries = gt.at(key);
    std::vector<double> visible;
    if (has_info)
      visible = located(info_file, "image " + key,
                        [&] { return read_visible(infos, info_file, key, entries.size()); });
    for (std::size_t i = 0; i < entries.size(); ++i) {
      TrueInstance instance = located(gt_file, "image " + key + ", instance " + std::to_string(i),
                                      [&] { return read_instance(entries.at(i)); });
      instance.scene_id = scene_id;
      instance.im_id = im_id;
      if (has_info) instance.visible = visible[i];
      truth.instances.push_back(instance);
    }
  }
}

void read_objects(const fs::path& folder, GroundTruth& truth) {
  const fs::path file = folder / "models_info.json";
  const json infos = read_json(file);
  for (const auto& item : infos.items()) {
    const int obj_id = number_of(item.key());
    if (obj_id < 0) fail(file, "'" + item.key() + "' is no obj_id");
    truth.objects[obj_id] =
        located(file, "object " + item.key(), [&] { return read_object(item.value()); });
  }
  for (const TrueInstance& instance : truth.instances) {
    const auto object = truth.objects.find(instance.obj_id);
    if (object == truth.objects.end())
      fail(file, "has no object " + std::to_string(instance.obj_id) + ", which scene " +
                     std::to_string(instance.scene_id) + " holds");
    if (object->second.points.rows() > 0) continue;
    char name[32];
    std::snprintf(name, sizeof name, "obj_%06d.ply", instance.obj_id);
    const fs::path model = folder / name;
    try {
      object->second.points = read_cloud(model, kMetresPerUnit).points;
    } catch (const std::exception& error) {
      fail(model, error.what());
    }
    if (object->second.points.rows() == 0) fail(model, "has no points");
  }
}

}  // namespace

GroundTruth read_ground_truth(const fs::path& dataset, const std::string& split) {
  const fs::path scenes = dataset / split;
  if (!fs::is_directory(scenes)) fail(scenes, "no such folder");
  std::map<int, fs::path> folders;
  for (const auto& entry : fs::directory_iterator(scenes))
    if (entry.is_directory() && number_of(entry.path().filename().string()) >= 0)
      folders[number_of(entry.path().filename().string())] = entry.path();
  GroundTruth truth;
  for (const auto& [scene_id, folder] : folders) read_scene(folder, scene_id, truth);
  if (truth.instances.empty())
    fail(scenes, "no true pose in it, expected NNNNNN/scene_gt.json as in a BOP data set");
  read_objects(dataset / "models", truth);
  return truth;
}

}  // namespace posevote
