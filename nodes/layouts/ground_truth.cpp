// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/ground_truth.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "nodes/formats/json_text.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/geometry/extreme_points.hpp"
#include "nodes/layouts/files.hpp"
#include "nodes/layouts/layout.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;

/// An object that is known by its points alone.
void measure_object(TrueObject& object) {
  const Eigen::RowVector3f low = object.points.colwise().minCoeff();
  const Eigen::RowVector3f high = object.points.colwise().maxCoeff();
  object.center = (0.5F * (low + high)).transpose().cast<double>();
  object.diameter = geometry::diameter_of(object.points);
}

/// A diameter lies between the longest side and the diagonal of the bounding box. Far from there,
/// one of the two is in another unit, and every pose would pass or fail.
void check_diameter(const TrueObject& object, const fs::path& model) {
  const Eigen::RowVector3f extent =
      object.points.colwise().maxCoeff() - object.points.colwise().minCoeff();
  const double side = static_cast<double>(extent.maxCoeff()),
               diagonal = static_cast<double>(extent.norm());
  if (object.diameter > 0.5 * side && object.diameter < 2 * diagonal) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "is a box of diagonal %.4g mm, but models_info says diameter %.4g mm: is one of them "
      "not in mm?",
      1e3 * diagonal, 1e3 * object.diameter);
  fail(model, text);
}

/// The vertices of the models that occur.
void read_models(const std::map<int, fs::path>& files, const fs::path& dataset,
                 GroundTruth& truth) {
  for (const TrueInstance& instance : truth.instances) {
    TrueObject& object = truth.objects.at(instance.obj_id);
    if (object.points.rows() > 0) continue;
    const auto file = files.find(instance.obj_id);
    if (file == files.end()) {
      char name[32];
      std::snprintf(name, sizeof name, "obj_%06d.ply", instance.obj_id);
      fail(dataset / "models" / name, "is missing, but has true poses");
    }
    try {
      const Mesh mesh = formats::read_mesh(file->second, 0.001);
      object.points = mesh.points;
      object.faces = mesh.faces;
    } catch (const std::exception& error) {
      fail(file->second, error.what());
    }
    if (object.points.rows() == 0) fail(file->second, "has no points");
    object.name = file->second.stem().string();
    if (object.diameter > 0)
      check_diameter(object, file->second);
    else
      measure_object(object);
    if (!(object.diameter > 0)) fail(file->second, "has no extent");
  }
}

void read_targets(GroundTruth& truth, const fs::path& file) {
  const auto list = formats::read_json<nlohmann::json>(file);
  if (!list.is_array() || list.empty()) fail(file, "is no JSON list of targets");
  for (std::size_t i = 0; i < list.size(); ++i) {
    try {
      const nlohmann::json& entry = list[i];
      const int scene = whole(entry, "scene_id"), image = whole(entry, "im_id"),
                object = whole(entry, "obj_id");
      truth.targets[{scene, image, object}] =
          entry.contains("inst_count") ? whole(entry, "inst_count", 1) : 1;
    } catch (const nlohmann::json::exception& error) {
      fail(file, "entry " + std::to_string(i) + ": " + formats::reason_of(error));
    } catch (const std::exception& error) {
      fail(file, "entry " + std::to_string(i) + ": " + error.what());
    }
  }
  std::map<std::tuple<int, int, int>, int> there;
  for (const TrueInstance& instance : truth.instances)
    ++there[{instance.scene_id, instance.im_id, instance.obj_id}];
  for (const auto& [key, count] : truth.targets)
    if (there[key] < count)
      fail(file, "asks for " + std::to_string(count) + " instances of object " +
                     std::to_string(std::get<2>(key)) + " in scene " +
                     std::to_string(std::get<0>(key)) + ", image " +
                     std::to_string(std::get<1>(key)) + ", the truth has " +
                     std::to_string(there[key]));
}

/// Leaves out the images that are no targets.
void keep_targets(GroundTruth& truth) {
  std::set<ImageKey> images;
  for (const auto& [key, count] : truth.targets) images.emplace(std::get<0>(key), std::get<1>(key));
  std::erase_if(truth.instances, [&](const TrueInstance& instance) {
    return !images.contains({instance.scene_id, instance.im_id});
  });
  for (auto image = truth.images.begin(); image != truth.images.end();) {
    const bool kept = images.contains(image->first);
    if (!kept) truth.left_out.insert(image->first);
    image = kept ? std::next(image) : truth.images.erase(image);
  }
}

/// Poses of an image that is not there contradict the images that are.
void check_images(const GroundTruth& truth, const fs::path& root) {
  const bool any_depth = std::any_of(truth.images.begin(), truth.images.end(),
                                     [](const auto& image) { return !image.second.depth.empty(); });
  for (const auto& [key, image] : truth.images)
    if (any_depth && image.depth.empty())
      fail(root, "scene " + std::to_string(key.first) + ", image " + std::to_string(key.second) +
                     " has true poses but no depth image, as others have");
}

}  // namespace

GroundTruth read_ground_truth(const fs::path& dataset, const std::string& split,
                              const std::string& targets) {
  const Layout& layout = find_layout(dataset, split);
  GroundTruth truth = layout.truth(dataset, split);
  const fs::path usual = dataset / "test_targets_bop19.json";
  const bool take_usual = targets.empty() && split == "test" && fs::exists(usual);
  if (take_usual || (!targets.empty() && targets != "none")) {
    read_targets(truth, take_usual ? usual : fs::path(targets));
    keep_targets(truth);
  }
  check_images(truth, dataset / split);
  read_models(number_models(layout.models(dataset)), dataset, truth);
  return truth;
}

}  // namespace posevote::layouts
