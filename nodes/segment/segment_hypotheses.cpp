// SPDX-License-Identifier: BSD-3-Clause
// What segment_objects does for votes, for the poses that a rival proposes: each time the pose that
// agrees best with the scan, of whatever object, refined by ICP, and what it explains taken out.
// Candidates, scores and thresholds are the same (poses/find_instances.hpp), so that a comparison
// is of what proposes the poses. As `density` a detection reports the support of the hypothesis
// that it came from.
//
//   segment_hypotheses: {in: [hypotheses, scene_features, scene_cloud, scale], out: detections}
#include "nodes/data/hypotheses.hpp"
#include "nodes/poses/segment_params.hpp"

namespace posevote::segment {
namespace {

poses::Proposals propose_from(const Hypotheses& object) {
  return {[&object] { return object.items; },
          [](const Hypothesis& hypothesis) { return hypothesis; }};
}

Detections segment_hypotheses(const PerObject<Hypotheses>& objects,
                              const FeatureSet& scene_features, const Cloud& scene_cloud,
                              const Scale& scale, const poses::SegmentParams& params) {
  poses::check_scan(scene_features, scene_cloud, scale);
  for (const auto& object : objects.slots) poses::check_model(*object->model);
  poses::ScanState scan(scene_cloud, scene_features, scale.resolution, params.terms,
                        objects.size());
  std::vector<poses::ObjectSearch> searches;
  for (const auto& object : objects.slots) {
    const Model& model = object->model->at(scan.resolution);
    searches.emplace_back(
        poses::Sought{model, scan, poses::instance_params(params, model, scan.resolution),
                      params.terms},
        propose_from(*object));
  }
  return poses::make_detections(
      poses::find_instances(searches, scan), params, [&](const poses::Instance& instance) {
        const poses::Candidate& candidate = instance.candidate;
        const Hypotheses& object = objects[instance.object];
        Detection detection =
            poses::make_detection(*object.model, candidate, params.terms.confidence);
        detection.density = candidate.proposed.support;
        detection.runner_up_density =
            poses::support_elsewhere(object.items, candidate.proposed.center, *object.model);
        return detection;
      });
}

const auto registered = poses::with_segment_params(
    graph::register_node("segment_hypotheses", segment_hypotheses,
                         "Rival: finds the instances of all objects among proposed poses.")
        .input("hypotheses")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .output("detections"));

}  // namespace
}  // namespace posevote::segment
