// SPDX-License-Identifier: BSD-3-Clause
// What segment_objects does for votes, for the poses that a rival proposes: objects one by one, the
// best supported first; for each the poses that agree best with the scan, refined by ICP, and what
// they explain taken out. Candidates, scores and thresholds are the same (find_instances.hpp), so
// that a comparison is of what proposes the poses. As `density` a detection reports the support of
// the hypothesis that it came from.
//
//   segment_hypotheses: {in: [hypotheses, scene_features, scene_cloud, scale], out: detections}
#include <algorithm>
#include <numeric>

#include "nodes/data/hypotheses.hpp"
#include "nodes/segment/segment_params.hpp"

namespace posevote {
namespace {

PoseMode mode_of(const Hypothesis& hypothesis, const Model& model) {
  return {(hypothesis.T_scene_model * model.center.cast<double>()).cast<float>(),
          Eigen::Quaternionf(hypothesis.T_scene_model.linear().cast<float>()), hypothesis.support};
}

double support_of(const Hypotheses& object) {
  return object.items.empty() ? 0 : object.items.front().support;
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

void segment_object(const Hypotheses& object, ScanState& scan, const SegmentParams& params,
                    Detections& found) {
  const Model& model = *object.model;
  const InstanceParams how = instance_params(params, model, scan.resolution);
  const Proposals proposals{[&](const ScanState&, const std::vector<Eigen::Vector3f>& taken) {
                              std::vector<PoseMode> modes;
                              for (const Hypothesis& hypothesis : object.items)
                                if (hypothesis.support >= params.min_density)
                                  modes.push_back(mode_of(hypothesis, model));
                              return separate_modes(modes, taken, how.nms_radius,
                                                    static_cast<std::size_t>(params.candidates));
                            },
                            [](const PoseMode& mode) { return mode; }};
  for (const Candidate& candidate : find_instances(model, proposals, how, scan)) {
    Detection detection = make_detection(model, candidate);
    detection.density = candidate.mode.support;
    detection.runner_up_density = runner_up_support(object, candidate.mode);
    found.items.push_back(std::move(detection));
  }
}

Detections segment_hypotheses(const PerObject<Hypotheses>& objects,
                              const FeatureSet& scene_features, const Cloud& scene_cloud,
                              const Scale& scale, const SegmentParams& params) {
  check_scan(scene_features, scene_cloud, scale);
  for (const auto& object : objects.slots) check_model(*object->model);
  std::vector<std::size_t> order(objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return support_of(objects[a]) > support_of(objects[b]);
  });
  ScanState scan(scene_cloud, scene_features, scale.resolution);
  Detections found;
  for (const std::size_t i : order) segment_object(objects[i], scan, params, found);
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
}  // namespace posevote
