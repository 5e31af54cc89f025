// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/run_inputs.hpp"

#include <algorithm>
#include <stdexcept>

#include "graph/node_call.hpp"
#include "graph/problem.hpp"
#include "nodes/layouts/layout.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/report/folder.hpp"

namespace posevote::page {
namespace {

namespace fs = std::filesystem;

/// The plan's node of a type, or null.
const graph::PlannedNode* find_type(const graph::Plan& plan, const std::string& type) {
  for (const graph::PlannedNode& node : plan.nodes)
    if (node.spec->name == type) return &node;
  return nullptr;
}

/// Runs one node on one value.
template <class Out, class In>
std::shared_ptr<const Out> call(const graph::PlannedNode& node, In input) {
  const std::vector<graph::Value> made =
      graph::call_node(node, {std::make_shared<const In>(std::move(input))}, {});
  return graph::StreamTraits<Out>::share(made.at(0));
}

fs::path real_path(const fs::path& path) {
  std::error_code none;
  const fs::path real = fs::weakly_canonical(path, none);
  return none ? path : real;
}

Mesh points_alone(const PointMatrix& points) { return {points, PointMatrix(0, 3), {}}; }

}  // namespace

RunInputs::RunInputs(const fs::path& folder, const TruthSource& truth)
    : records_(read_run_records(folder)) {
  if (records_.empty())
    notes_.emplace_back(
        "run.json is not there or cannot be read: the command line is not known, nor where the "
        "models are, nor which were never found.");
  else
    record_ = records_.back();
  models_ = record_.models;
  std::sort(models_.begin(), models_.end(),
            [](const auto& a, const auto& b) { return a.obj_id < b.obj_id; });
  read_configuration(folder);
  const bool is_named = !truth.dataset.empty();
  is_runs_dataset_ = !is_named && !record_.dataset.empty();
  if (is_named) read_dataset(truth);
  if (is_runs_dataset_) read_dataset({find(record_.dataset).string(), record_.split});
}

void RunInputs::read_configuration(const fs::path& folder) {
  const fs::path file = folder / "effective.yaml";
  try {
    if (!is_file(file)) throw std::invalid_argument(file.string() + ": no such file");
    configuration_ = load_configuration(fs::absolute(file).string(), {});
  } catch (const std::exception& error) {  // graph::ConfigError is none of std::invalid_argument
    no_configuration_ = error.what();
    notes_.push_back("The scans cannot be read as the run did: " + no_configuration_);
  }
}

void RunInputs::read_dataset(const TruthSource& source) {
  try {
    const layouts::Layout& layout = layouts::find_layout(source.dataset, source.split);
    for (SceneFile& scene : layout.scenes(source.dataset, source.split))
      scenes_.emplace(real_path(scene.path), std::move(scene));
  } catch (const std::runtime_error& error) {
    if (!is_runs_dataset_) throw std::invalid_argument(error.what());
    notes_.push_back(std::string("The data set cannot be read any more: ") + error.what());
    return;
  }
  read_truth(source);
}

void RunInputs::read_truth(const TruthSource& source) try {
  truth_ = layouts::read_ground_truth(source.dataset, source.split, "none");
} catch (const std::runtime_error& error) {
  if (!is_runs_dataset_) throw std::invalid_argument(error.what());
  notes_.push_back(std::string("No true poses: ") + error.what());
}

fs::path RunInputs::find(const std::string& file) const {
  const fs::path there = fs::path(record_.folder) / file;
  return record_.folder.empty() || (!fs::exists(there) && fs::exists(file)) ? fs::path(file)
                                                                            : there;
}

SceneFile RunInputs::locate(const std::string& file, int scene_id, int im_id) const {
  const fs::path path = find(file);
  const auto known = scenes_.find(real_path(path));
  if (known != scenes_.end()) return known->second;
  return {path, scene_id, im_id, std::nullopt};
}

Scan RunInputs::load(const std::string& file, int scene_id, int im_id) const {
  if (!configuration_) throw std::runtime_error(file + ": effective.yaml cannot be used");
  const SceneFile scene = locate(file, scene_id, im_id);
  const graph::PlannedNode* load_scene = find_type(configuration_->scenes, "load_scene");
  if (!load_scene) throw std::runtime_error(file + ": the run's pipeline has no load_scene");
  try {
    return *call<Scan>(*load_scene, scene);
  } catch (const std::exception& error) {
    throw std::runtime_error(scene.path.string() + ": " + error.what());
  }
}

std::vector<layouts::TrueInstance> RunInputs::truths(const std::string& file, int scene_id,
                                                     int im_id) const {
  if (!truth_) return {};
  const auto known = scenes_.find(real_path(find(file)));
  // The numbers of the run are those of its own data set only.
  if (known == scenes_.end() && !is_runs_dataset_) return {};
  if (known != scenes_.end()) {
    scene_id = known->second.scene_id;
    im_id = known->second.im_id;
  }
  std::vector<layouts::TrueInstance> instances;
  for (const layouts::TrueInstance& instance : truth_->instances)
    if (instance.scene_id == scene_id && instance.im_id == im_id) instances.push_back(instance);
  return instances;
}

std::map<int, Mesh> RunInputs::load_surfaces() {
  std::map<int, Mesh> surfaces;
  if (truth_)
    for (const auto& [obj_id, object] : truth_->objects)
      surfaces[obj_id] = {object.points, PointMatrix(0, 3), object.faces};
  if (!configuration_) return surfaces;
  try {
    if (!record_.library.empty()) {
      const auto trained = library();
      for (const auto& model : trained->models)
        surfaces[model->obj_id] = points_alone(model->cloud.points);
    }
  } catch (const std::exception& error) {
    notes_.emplace_back(error.what());
  }
  const graph::PlannedNode* load_models = find_type(configuration_->models, "load_models");
  ModelFiles files;
  for (const SoughtModel& model : models_)
    if (!model.file.empty()) files.push_back({find(model.file), model.obj_id, model.name});
  // All at once, but for those that are gone: an unknown unit is told by the largest.
  while (load_models && !files.empty()) try {
      const auto meshes = call<PerObject<Mesh>>(*load_models, files);
      for (std::size_t i = 0; i < files.size(); ++i) surfaces[files[i].obj_id] = (*meshes)[i];
      break;
    } catch (const graph::ObjectErrors& errors) {
      for (auto failed = errors.objects.rbegin(); failed != errors.objects.rend(); ++failed) {
        const auto file = files.begin() + std::ptrdiff_t(failed->object);
        notes_.push_back("The model " + file->path.string() + " is not shown: " + failed->cause);
        files.erase(file);
      }
    }
  return surfaces;
}

std::string RunInputs::true_name(int obj_id) const {
  if (!truth_) return "";
  const auto object = truth_->objects.find(obj_id);
  return object == truth_->objects.end() ? "" : object->second.name;
}

const Configuration& RunInputs::configuration() const {
  if (!configuration_) throw std::invalid_argument(no_configuration_);
  return *configuration_;
}

std::shared_ptr<const ModelLibrary> RunInputs::library() const {
  if (!record_.library.empty()) {
    std::string why_not;
    const std::string file = find(record_.library).string();
    auto library = library::load_library(file, library_key(configuration()), why_not);
    if (!library) throw std::invalid_argument(file + ": " + why_not);
    return std::make_shared<const ModelLibrary>(std::move(*library));
  }
  std::vector<std::string> files;
  for (const SoughtModel& model : models_) files.push_back(find(model.file).string());
  if (files.empty())
    throw std::invalid_argument("run.json does not say where the run's models are");
  return as_arguments([&] {
    return cached_library(configuration(), list_models(files), default_cache(),
                          BadModels::kLeaveOut);
  });
}

}  // namespace posevote::page
