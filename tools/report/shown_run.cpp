// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/shown_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "graph/node_call.hpp"
#include "graph/problem.hpp"
#include "graph/wiring.hpp"
#include "nodes/layouts/layout.hpp"

namespace posevote::page {
namespace {

namespace fs = std::filesystem;

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

ShownRun::ShownRun(const fs::path& folder, const TruthSource& truth) : inputs_(folder) {
  const Manifest& run = inputs_.manifest();
  if (!inputs_.why_not().empty())
    notes_.push_back(inputs_.why_not() +
                     ": the command line is not known, nor where the models are, nor which were "
                     "never found.");
  models_ = run.models;
  std::sort(models_.begin(), models_.end(),
            [](const auto& a, const auto& b) { return a.obj_id < b.obj_id; });
  read_configuration();
  const bool is_named = !truth.dataset.empty();
  is_runs_dataset_ = !is_named && !run.dataset.empty();
  if (is_named) read_dataset(truth);
  if (is_runs_dataset_) read_dataset({inputs_.find(run.dataset).string(), run.split});
}

void ShownRun::read_configuration() {
  try {
    configuration_ = inputs_.configuration();
  } catch (const std::exception& error) {  // graph::ConfigError is none of std::invalid_argument
    no_configuration_ = error.what();
    notes_.push_back("The scans cannot be read as the run did: " + no_configuration_);
  }
}

void ShownRun::read_dataset(const TruthSource& source) {
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

void ShownRun::read_truth(const TruthSource& source) try {
  truth_ = layouts::read_ground_truth(source.dataset, source.split, "none");
} catch (const std::runtime_error& error) {
  if (!is_runs_dataset_) throw std::invalid_argument(error.what());
  notes_.push_back(std::string("No true poses: ") + error.what());
}

SceneFile ShownRun::locate(const ScanName& scan) const {
  return inputs_.scene(scan.frame, scan.file, scan.scene_id, scan.im_id);
}

Scan ShownRun::load(const ScanName& name) const {
  if (!configuration_) throw std::runtime_error(name.file + ": effective.yaml cannot be used");
  const SceneFile scene = locate(name);
  const graph::PlannedNode* load_scene = graph::find_type(configuration_->scenes, "load_scene");
  if (!load_scene) throw std::runtime_error(name.file + ": the run's pipeline has no load_scene");
  try {
    return *call<Scan>(*load_scene, scene);
  } catch (const std::exception& error) {
    throw std::runtime_error(scene.path.string() + ": " + error.what());
  }
}

std::vector<layouts::TrueInstance> ShownRun::truths(const ScanName& scan) const {
  if (!truth_) return {};
  const auto known = scenes_.find(real_path(inputs_.find(scan.file)));
  // The numbers of the run are those of its own data set only.
  if (known == scenes_.end() && !is_runs_dataset_) return {};
  const int scene_id = known != scenes_.end() ? known->second.scene_id : scan.scene_id;
  const int im_id = known != scenes_.end() ? known->second.im_id : scan.im_id;
  std::vector<layouts::TrueInstance> instances;
  for (const layouts::TrueInstance& instance : truth_->instances)
    if (instance.scene_id == scene_id && instance.im_id == im_id) instances.push_back(instance);
  return instances;
}

std::map<int, Mesh> ShownRun::load_surfaces() {
  std::map<int, Mesh> surfaces;
  if (truth_)
    for (const auto& [obj_id, object] : truth_->objects)
      surfaces[obj_id] = {object.points, PointMatrix(0, 3), object.faces};
  if (!configuration_) return surfaces;
  try {
    if (!inputs_.manifest().library.empty()) {
      const auto trained = library();
      for (const auto& model : trained->models)
        surfaces[model->obj_id] = points_alone(model->cloud.points);
    }
  } catch (const std::exception& error) {
    notes_.emplace_back(error.what());
  }
  const graph::PlannedNode* load_models = graph::find_type(configuration_->models, "load_models");
  ModelFiles files;
  for (const SoughtModel& model : models_)
    if (!model.file.empty()) files.push_back({inputs_.find(model.file), model.obj_id, model.name});
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

std::string ShownRun::true_name(int obj_id) const {
  if (!truth_) return "";
  const auto object = truth_->objects.find(obj_id);
  return object == truth_->objects.end() ? "" : object->second.name;
}

const Configuration& ShownRun::configuration() const {
  if (!configuration_) throw std::invalid_argument(no_configuration_);
  return *configuration_;
}

}  // namespace posevote::page
