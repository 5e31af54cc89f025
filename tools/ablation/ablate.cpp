// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <set>

#include "graph/runner.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/votes.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/ablation/ablation.hpp"
#include "tools/ablation/replay.hpp"
#include "tools/ablation/variations.hpp"
#include "tools/evaluate/evaluate.hpp"

namespace posevote::ablation {
namespace {

using Library = std::shared_ptr<const ModelLibrary>;

/// A variation, its models where they are others than the run's, and what it finds.
struct Trial {
  Variation variation;
  Library library;
  std::vector<FoundInstance> found;
  double seconds = 0;
};

/// Laser scans are judged as the paper does, RGB-D by ADI, which minds no symmetry.
std::string rule_for(const std::string& config) {
  return config == "uwa" || config == "queens" ? "pose" : "adi15";
}

/// Whatever their slots refer to, the votes are for the models of this library.
graph::Value votes_for(const ModelLibrary& library, const graph::Value& votes) {
  using Votes = graph::StreamTraits<PerObject<VoteSet>>;
  PerObject<VoteSet> all;
  for (const auto& slot : Votes::unwrap(votes).slots) {
    VoteSet copy = *slot;
    for (const auto& model : library.models)
      if (model->obj_id == copy.model->obj_id) copy.model = model;
    all.slots.push_back(std::make_shared<const VoteSet>(std::move(copy)));
  }
  return Votes::wrap(std::move(all));
}

/// The trials that change the segmentation, after one that changes nothing.
std::vector<Trial> make_trials(const Configuration& configuration, const ModelFiles& models,
                               const std::vector<std::string>& terms) {
  const graph::PlannedNode& segmentation = find_planned(configuration.scenes, kSegmentation);
  std::vector<Trial> trials{{unchanged(segmentation), nullptr, {}, 0}};
  for (Variation& variation : vary(segmentation, terms))
    trials.push_back({std::move(variation), nullptr, {}, 0});
  std::vector<Variation> training = vary(find_planned(configuration.models, kTraining), terms);
  if (training.empty()) return trials;
  std::fprintf(stderr, "training anew for %zu variations\n", training.size());
  const Replay replay(configuration.models, {}, {std::make_shared<const ModelFiles>(models)});
  for (Variation& variation : training) {
    auto library = graph::StreamTraits<ModelLibrary>::share(replay.rerun(variation.node));
    variation.node = segmentation;
    trials.push_back({std::move(variation), std::move(library), {}, 0});
  }
  return trials;
}

void run(Trial& trial, const Replay& scan, const SceneFile& file) {
  std::map<std::string, graph::Value> instead;
  if (trial.library) instead["votes"] = votes_for(*trial.library, scan.value("votes"));
  const auto begin = std::chrono::steady_clock::now();
  const graph::Value result = scan.rerun(trial.variation.node, instead);
  trial.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const Detection& one : graph::StreamTraits<Detections>::unwrap(result).items)
    trial.found.push_back(
        {0, file.scene_id, file.im_id, one.obj_id, one.confidence, one.T_scene_model});
}

Outcome judge(const Trial& trial, const layouts::GroundTruth& truth, const std::string& rule) {
  EvaluateOptions options;
  options.rules = rule;
  const Counts counts = evaluate(truth, trial.found, options).all[0].counts;
  return {counts.instances, counts.correct, counts.detections - static_cast<int>(counts.correct),
          trial.seconds};
}

}  // namespace

std::vector<Row> ablate(const TestSet& set, const std::vector<std::string>& terms,
                        const std::filesystem::path& cache, const std::atomic<bool>& interrupted) {
  const std::string split = "test";
  const Configuration configuration = load_configuration(set.config, {});
  const ModelFiles models = list_models(list_dataset_models(set.dataset.string(), split));
  const Library library = cached_library(configuration, models, cache);
  const graph::Constants constants = constants_of(configuration, library);
  std::vector<Trial> trials = make_trials(configuration, models, terms);
  const auto scenes = take_shard(list_dataset_scenes(set.dataset.string(), split),
                                 "1/" + std::to_string(set.every));
  std::set<layouts::ImageKey> seen;
  for (const SceneEntry& scene : scenes) {
    if (interrupted) break;
    std::fprintf(stderr, "%s: image %zu of %zu, %zu variations\n", set.name.c_str(),
                 seen.size() + 1, scenes.size(), trials.size() - 1);
    const Replay scan(configuration.scenes, constants,
                      {std::make_shared<const SceneFile>(scene.file)});
    for (Trial& trial : trials) run(trial, scan, scene.file);
    seen.insert({scene.file.scene_id, scene.file.im_id});
  }
  layouts::GroundTruth truth = layouts::read_ground_truth(set.dataset, split);
  std::erase_if(truth.instances, [&](const layouts::TrueInstance& instance) {
    return !seen.contains({instance.scene_id, instance.im_id});
  });
  std::vector<Row> rows;
  for (const Trial& trial : trials)
    rows.push_back({trial.variation.term,
                    trial.variation.change,
                    trial.variation.value,
                    {judge(trial, truth, rule_for(set.config))}});
  return rows;
}

}  // namespace posevote::ablation
