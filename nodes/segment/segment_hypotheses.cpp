// SPDX-License-Identifier: BSD-3-Clause
// What segment_objects does for votes, for the poses that a rival proposes: each time the pose that
// agrees best with the scan, of whatever object, refined by ICP, and what it explains taken out.
// Candidates, scores and thresholds are the same (find_instances.hpp), so that a comparison is of
// what proposes the poses. As `density` a detection reports the support of the hypothesis that it
// came from.
//
//   segment_hypotheses: {in: [hypotheses, scene_features, scene_cloud, scale], out: detections}
#include <algorithm>

#include "nodes/data/hypotheses.hpp"
#include "nodes/segment/refine_mode.hpp"
#include "nodes/segment/segment_params.hpp"

namespace posevote::segment {
namespace {

PoseMode mode_of(const Hypothesis& hypothesis, const Model& model) {
  return {posed_center(hypothesis.T_scene_model, model.center).cast<float>(),
          Eigen::Quaternionf(hypothesis.T_scene_model.linear().cast<float>()), hypothesis.support};
}

/// The best support of a hypothesis elsewhere.
double runner_up_support(const Hypotheses& object, const PoseMode& mode) {
  const Model& model = *object.model;
  double best = 0;
  for (const Hypothesis& hypothesis : object.items) {
    const float distance = (mode_of(hypothesis, model).center - mode.center).norm();
    if (distance > kRunnerUpRadius * model.diagonal) best = std::max(best, hypothesis.support);
  }
  return best;
}

Proposals propose_from(const Hypotheses& object, double min_density) {
  return {[&object, min_density] {
            std::vector<PoseMode> modes;
            for (const Hypothesis& hypothesis : object.items)
              if (hypothesis.support >= min_density)
                modes.push_back(mode_of(hypothesis, *object.model));
            return modes;
          },
          [](const PoseMode& mode) { return mode; }};
}

Detections segment_hypotheses(const PerObject<Hypotheses>& objects,
                              const FeatureSet& scene_features, const Cloud& scene_cloud,
                              const Scale& scale, const SegmentParams& params) {
  check_scan(scene_features, scene_cloud, scale);
  for (const auto& object : objects.slots) check_model(*object->model);
  ScanState scan(scene_cloud, scene_features, scale.resolution);
  std::vector<ObjectSearch> searches;
  for (const auto& object : objects.slots)
    searches.emplace_back(*object->model, propose_from(*object, params.min_density),
                          instance_params(params, *object->model, scan.resolution), scan);
  Detections found;
  for (const Instance& instance : find_instances(searches, scan)) {
    const Hypotheses& object = objects[instance.object];
    Detection& detection =
        found.items.emplace_back(make_detection(*object.model, instance.candidate));
    detection.density = instance.candidate.mode.support;
    detection.runner_up_density = runner_up_support(object, instance.candidate.mode);
  }
  return found;
}

const auto registered = with_segment_params(
    graph::register_node("segment_hypotheses", segment_hypotheses,
                         "Rival: finds the instances of all objects among proposed poses.")
        .input("hypotheses")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .output("detections"));

}  // namespace
}  // namespace posevote::segment
