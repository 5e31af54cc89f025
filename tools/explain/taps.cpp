// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/taps.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "graph/yaml_reader.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"

namespace posevote::explain {
namespace {

namespace fs = std::filesystem;

const graph::PlannedNode* find_type(const graph::Plan& plan, const std::string& type) {
  for (const graph::PlannedNode& node : plan.nodes)
    if (node.spec->name == type) return &node;
  return nullptr;
}

/// The node of that type, without which there is nothing to explain.
const graph::PlannedNode& node_of_type(const graph::Plan& plan, const std::string& type) {
  if (const graph::PlannedNode* node = find_type(plan, type)) return *node;
  throw std::invalid_argument("the pipeline '" + plan.name + "' has no " + type +
                              ": expected one that votes, as recognize");
}

/// That of a stream, too: a frame is explained as if it were its first.
const graph::PlannedNode& segmentation_of(const graph::Plan& plan) {
  const graph::PlannedNode* of_stream = find_type(plan, "segment_new_objects");
  return of_stream ? *of_stream : node_of_type(plan, "segment_objects");
}

/// The stream at a port of a node.
const std::string& input_stream(const graph::Plan& plan, const graph::PlannedNode& node,
                                const std::string& port) {
  for (std::size_t i = 0; i < node.spec->inputs.size(); ++i)
    if (node.spec->inputs[i].name == port) return plan.streams[std::size_t(node.inputs[i])].name;
  throw std::invalid_argument(node.name + ": has no input " + port);
}

ModelFiles find_models(const RunInputs& inputs) {
  std::vector<std::string> files = inputs.models;
  if (files.empty() && !inputs.dataset.empty())
    files = list_dataset_models(inputs.dataset, inputs.split);
  if (files.empty())
    throw std::invalid_argument("the run names no models; say --models FILE... or --dataset DIR");
  return list_models(files);
}

std::shared_ptr<const ModelLibrary> find_library(const Run& run) {
  if (run.inputs.library.empty())
    return cached_library(run.configuration, find_models(run.inputs),
                          run.inputs.cache.empty() ? default_cache() : fs::path(run.inputs.cache),
                          BadModels::kLeaveOut);
  std::string why_not;
  auto library = library::load_library(run.inputs.library, library_key(run.configuration), why_not);
  if (!library) throw std::invalid_argument(run.inputs.library + ": " + why_not);
  return std::make_shared<const ModelLibrary>(std::move(*library));
}

template <class T>
T tapped(const ablation::Replay& replay, const graph::Plan& plan, const graph::PlannedNode& node,
         const std::string& port) {
  return T(graph::StreamTraits<T>::unwrap(replay.value(input_stream(plan, node, port))));
}

}  // namespace

const poses::SegmentParams& Run::segmentation() const {
  return *static_cast<const poses::SegmentParams*>(
      segmentation_of(configuration.scenes).params.get());
}

Run open_run(const fs::path& out, const std::vector<std::string>& models,
             const std::string& dataset) {
  Run run;
  run.out = out;
  run.frames = read_run_frames(out);
  run.inputs = read_inputs(out);
  if (!models.empty()) {
    run.inputs.library.clear();
    run.inputs.models = models;
  }
  if (run.inputs.dataset.empty()) run.inputs.dataset = dataset;
  run.configuration = load_configuration((out / "effective.yaml").string(), {});
  segmentation_of(run.configuration.scenes);
  node_of_type(run.configuration.scenes, "match_features");
  run.library = as_arguments([&] { return find_library(run); });
  run.constants = constants_of(run.configuration, run.library);
  return run;
}

SceneFile scene_file(const Run& run, const FrameOfRun& frame) {
  if (!run.inputs.dataset.empty())
    for (const SceneEntry& entry : list_dataset_scenes(run.inputs.dataset, run.inputs.split))
      if (entry.number == frame.number && entry.file.path.filename() == frame.file.filename())
        return entry.file;
  SceneFile file{frame.file, frame.scene_id, frame.im_id, std::nullopt};
  if (!fs::exists(file.path) && file.path.is_relative())
    file.path = fs::path(run.inputs.folder) / file.path;
  if (!fs::exists(file.path))
    throw std::invalid_argument(file.path.string() + ": the scan of frame '" + frame.name +
                                "' is not there any more");
  return file;
}

graph::FrameContext Taps::listen() {
  graph::FrameContext context;
  context.seed = run.inputs.seed;
  context.file = file.path;
  context.on_figure = [this](const std::string& what, std::vector<double> values) {
    const std::scoped_lock lock(telling_);
    figures[what] = std::move(values);
  };
  context.on_warning = [this](const std::string& what) {
    const std::scoped_lock lock(telling_);
    if (std::find(warnings.begin(), warnings.end(), what) == warnings.end())
      warnings.push_back(what);
  };
  return context;
}

Taps::Taps(const Run& of, const FrameOfRun& frame) : run(of), file(scene_file(of, frame)) {
  const graph::Plan& plan = run.configuration.scenes;
  replay_ = std::make_unique<ablation::Replay>(
      plan, run.constants, std::vector<graph::Value>{std::make_shared<const SceneFile>(file)},
      listen());
  const graph::PlannedNode& segment = segmentation_of(plan);
  cloud = tapped<std::shared_ptr<const Cloud>>(*replay_, plan, segment, "scene_cloud");
  features = tapped<std::shared_ptr<const FeatureSet>>(*replay_, plan, segment, "scene_features");
  scale = tapped<Scale>(*replay_, plan, segment, "scale");
  votes = tapped<PerObject<VoteSet>>(*replay_, plan, segment, "votes");
  densities = tapped<PerObject<VoteDensity>>(*replay_, plan, segment, "densities");
  const graph::PlannedNode& match = node_of_type(plan, "match_features");
  correspondences = graph::StreamTraits<PerObject<Correspondences>>::unwrap(
      replay_->value(plan.streams[std::size_t(match.outputs.at(0))].name));
  detections = graph::StreamTraits<Detections>::unwrap(
      replay_->value(plan.streams[std::size_t(plan.result)].name));
}

std::optional<Detections> Taps::rerun(const std::string& setting) const {
  std::vector<graph::Problem> problems;
  const graph::Override change = graph::read_set(setting, problems);
  if (!problems.empty()) return std::nullopt;
  for (const graph::PlannedNode& node : run.configuration.scenes.nodes) {
    if (node.name != change.node) continue;
    graph::PlannedNode changed = node;
    changed.params = node.spec->make_params();
    for (const graph::ParamSpec& param : node.spec->params) {
      const bool is_it = param.name == change.key;
      const std::string text = is_it ? change.setting.text : param.get(node.params.get());
      if (param.set(changed.params.get(), text)) return std::nullopt;
    }
    return Detections(graph::StreamTraits<Detections>::unwrap(replay_->rerun(changed)));
  }
  return std::nullopt;
}

double Taps::figure(const std::string& name, double otherwise) const {
  const auto at = figures.find(name);
  return at == figures.end() || at->second.empty() ? otherwise : at->second.front();
}

}  // namespace posevote::explain
