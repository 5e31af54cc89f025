// SPDX-License-Identifier: BSD-3-Clause
// Greedy segmentation of a scan into objects (Buch, Kiforenko, Kraft, ICCV 2017, section 4):
// objects in descending number of correspondences; for each the mode of the vote density that
// agrees best with the scan, refined by ICP (find_instances.hpp), and the scan points it explains
// taken out before the next is sought. Correspondences that start at explained points are taken out
// of all objects; their votes are subtracted from the densities, which equals voting anew without
// them. The score rests on what the sensor measured, free space included (measure_fit.cpp). Cost:
// per object `candidates` glances, 100 neighbourhood queries and looks, per instance five ICPs. A
// scan without votes gives no detections; that is no failure. Points without a normal are never
// matched. Known limits: an object of which one flat side alone is seen scores low; of two objects
// that claim the same points the one with more correspondences gets them.
//
//   segment_objects: {in: [votes, densities, scene_features, scene_cloud, scale], out: detections,
//                     max_instances: 1}
#include <algorithm>
#include <numeric>

#include "nodes/segment/live_votes.hpp"
#include "nodes/segment/refine_mode.hpp"
#include "nodes/segment/segment_params.hpp"

namespace posevote {
namespace {

/// Objects in descending number of correspondences; equals in ascending obj_id, then as given.
std::vector<std::size_t> order_objects(const PerObject<VoteSet>& votes) {
  std::vector<std::size_t> order(votes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&votes](std::size_t a, std::size_t b) {
    const std::size_t count_a = votes[a].scene_feature.size();
    const std::size_t count_b = votes[b].scene_feature.size();
    return count_a != count_b ? count_a > count_b : votes[a].model->obj_id < votes[b].model->obj_id;
  });
  return order;
}

Detection make_detection(const LiveVotes& object, const Candidate& candidate) {
  const Model& model = *object.votes->model;
  Detection detection = make_detection(model, candidate);
  detection.density = raw_density(*object.raw, candidate.mode);
  detection.runner_up_density = runner_up_density(
      *object.votes, object.raw->density, candidate.mode.center, kRunnerUpRadius * model.diagonal);
  return detection;
}

/// All instances of one object.
void segment_object(LiveVotes object, ScanState& scan, const SegmentParams& params,
                    Detections& found) {
  const Model& model = *object.votes->model;
  const InstanceParams how = instance_params(params, model, scan.resolution);
  const Proposals proposals{[&](const ScanState& now, const std::vector<Eigen::Vector3f>& taken) {
                              remove_explained(object, now.feature_explained);
                              std::vector<PoseMode> modes;
                              for (const std::uint32_t vote :
                                   best_votes(*object.votes, object.density, params.min_density)) {
                                modes.push_back(vote_pose(*object.votes, vote));
                                modes.back().support = object.density[vote];
                              }
                              return separate_modes(modes, taken, how.nms_radius,
                                                    static_cast<std::size_t>(params.candidates));
                            },
                            [&](const PoseMode& mode) {
                              return refine_mode(*object.votes, *object.raw, object.alive, mode);
                            }};
  for (const Candidate& candidate : find_instances(model, proposals, how, scan))
    found.items.push_back(make_detection(object, candidate));
}

Detections segment_objects(const PerObject<VoteSet>& votes, const PerObject<VoteDensity>& densities,
                           const FeatureSet& scene_features, const Cloud& scene_cloud,
                           const Scale& scale, const SegmentParams& params) {
  check_scan(scene_features, scene_cloud, scale);
  check_votes(votes, densities, static_cast<std::size_t>(scene_features.points.rows()));
  for (const auto& slot : votes.slots) check_model(*slot->model);
  ScanState scan(scene_cloud, scene_features, scale.resolution);
  Detections found;
  for (const std::size_t i : order_objects(votes))
    segment_object(all_votes(votes[i], densities[i]), scan, params, found);
  return found;
}

const auto registered = with_segment_params(
    graph::register_node("segment_objects", segment_objects,
                         "Finds the instances of all objects one by one, taking what each explains "
                         "out of the scan.")
        .input("votes")
        .input("densities")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .output("detections"));

}  // namespace
}  // namespace posevote
