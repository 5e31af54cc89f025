// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/taps.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "graph/wiring.hpp"
#include "graph/yaml_reader.hpp"
#include "nodes/formats/format.hpp"

namespace posevote::explain {
namespace {

namespace fs = std::filesystem;

/// The node of that type, without which there is nothing to explain.
const graph::PlannedNode& node_of_type(const graph::Plan& plan, const std::string& type) {
  if (const graph::PlannedNode* node = graph::find_type(plan, type)) return *node;
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

Run open_run(const fs::path& out, const std::vector<std::string>& models) {
  RunInputs inputs(out);
  inputs.use_models(models);
  Configuration configuration = inputs.configuration();
  Run run{out, std::move(inputs), read_run_frames(out), std::move(configuration), {}, {}};
  segmentation_of(run.configuration.scenes);
  node_of_type(run.configuration.scenes, "match_features");
  run.library = run.inputs.library(run.configuration);
  run.constants = constants_of(run.configuration, run.library);
  return run;
}

SceneFile scene_file(const Run& run, const FrameOfRun& frame) {
  SceneFile file = run.inputs.scene(frame.number, frame.file, frame.scene_id, frame.im_id);
  if (!fs::exists(formats::file_of(file.path)))
    throw std::invalid_argument(file.path.string() + ": the scan of frame '" + frame.name +
                                "' is not there any more");
  return file;
}

graph::FrameContext Taps::listen() {
  graph::FrameContext context;
  context.seed = run.inputs.manifest().seed;
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
