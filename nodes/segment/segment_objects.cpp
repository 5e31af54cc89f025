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
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/segment/find_instances.hpp"
#include "nodes/segment/find_modes.hpp"
#include "nodes/segment/live_votes.hpp"
#include "nodes/segment/refine_mode.hpp"
#include "nodes/segment/scan_state.hpp"

namespace posevote {
namespace {

constexpr float kRunnerUpRadius = 0.2F;  // x diagonal; part of what runner_up_density means

struct Params {
  int max_instances = 1;
  int candidates = 1000;
  double nms = 0.2;
  double min_density = 3;
  double min_score = 0.2;
  bool refine = true;
  double icp_distance = 5;
  int icp_iterations = 40;
  double inlier_distance = 2;
  double explained_distance = 3;
};

InstanceParams instance_params(const Params& params, const Model& model, float resolution) {
  const auto length = [&](double multiple) { return static_cast<float>(multiple) * resolution; };
  InstanceParams out;
  out.max_instances = params.max_instances;
  out.min_score = params.min_score;
  out.nms_radius = static_cast<float>(params.nms) * model.diagonal;
  out.refine = params.refine;
  out.icp_iterations = params.icp_iterations;
  out.icp_distance = length(params.icp_distance);
  out.tolerance = length(params.inlier_distance);
  out.explained_distance = length(params.explained_distance);
  return out;
}

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
  Detection detection;
  detection.obj_id = model.obj_id;
  detection.model = model.name;
  detection.score = candidate.score;
  detection.density = raw_density(*object.raw, candidate.mode);
  detection.runner_up_density = runner_up_density(
      *object.votes, object.raw->density, candidate.mode.center, kRunnerUpRadius * model.diagonal);
  detection.inlier_fraction = candidate.fit.inlier_fraction;
  detection.rmse = candidate.fit.rmse;
  detection.T_scene_model = candidate.T_scene_model;
  return detection;
}

/// All instances of one object.
void segment_object(LiveVotes object, ScanState& scan, const Params& params, Detections& found) {
  const Model& model = *object.votes->model;
  const InstanceParams how = instance_params(params, model, scan.resolution);
  const Proposals proposals{
      [&](const ScanState& now, const std::vector<Eigen::Vector3f>& taken) {
        remove_explained(object, now.feature_explained);
        return separate_modes(*object.votes,
                              best_votes(*object.votes, object.density, params.min_density), taken,
                              how.nms_radius, static_cast<std::size_t>(params.candidates));
      },
      [&](const PoseMode& mode) {
        return refine_mode(*object.votes, *object.raw, object.alive, mode);
      }};
  for (const Candidate& candidate : find_instances(model, proposals, how, scan))
    found.items.push_back(make_detection(object, candidate));
}

/// A point set without a normal for each point is refused; a normal of length 0 is not.
void check_normals(const std::string& what, const PointMatrix& points, const PointMatrix& normals) {
  if (normals.rows() == points.rows()) return;
  throw std::runtime_error(what + " has " + std::to_string(points.rows()) + " points but " +
                           std::to_string(normals.rows()) + " normals");
}

void check_inputs(const PerObject<VoteSet>& votes, const PerObject<VoteDensity>& densities,
                  const FeatureSet& scene_features, const Cloud& scene_cloud, const Scale& scale) {
  if (!(scale.resolution > 0) || !std::isfinite(scale.resolution))
    throw std::runtime_error("resolution is " + std::to_string(scale.resolution) +
                             " m, expected more than 0");
  check_normals("the scan", scene_cloud.points, scene_cloud.normals);
  check_normals("the feature set", scene_features.points, scene_features.normals);
  check_votes(votes, densities, static_cast<std::size_t>(scene_features.points.rows()));
  for (const auto& slot : votes.slots)
    check_normals("model " + slot->model->name, slot->model->cloud.points,
                  slot->model->cloud.normals);
}

Detections segment_objects(const PerObject<VoteSet>& votes, const PerObject<VoteDensity>& densities,
                           const FeatureSet& scene_features, const Cloud& scene_cloud,
                           const Scale& scale, const Params& params) {
  check_inputs(votes, densities, scene_features, scene_cloud, scale);
  ScanState scan(scene_cloud, scene_features, scale.resolution);
  Detections found;
  for (const std::size_t i : order_objects(votes))
    segment_object(all_votes(votes[i], densities[i]), scan, params, found);
  return found;
}

const auto registered =
    graph::register_node("segment_objects", segment_objects,
                         "Finds the instances of all objects one by one, taking what each explains "
                         "out of the scan.")
        .input("votes")
        .input("densities")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .output("detections")
        .param("max_instances", &Params::max_instances, "", "Instances per object, at most.",
               graph::in_range(1, 1000))
        .param("candidates", &Params::candidates, "",
               "Densest modes of which each instance is chosen; 1: the densest, as in the paper.",
               graph::in_range(1, 10000))
        .param("nms", &Params::nms, "x diagonal",
               "Modes of one object lie farther apart than this share of its bounding box.",
               graph::in_range(0, 10))
        .param("min_density", &Params::min_density, "votes",
               "A mode of lower density (of the votes that are left) is not tried.",
               graph::at_least(0))
        .param("min_score", &Params::min_score, "", "Detections of lower score are rejected.",
               graph::in_range(0, 1))
        .param("refine", &Params::refine, "", "Whether modes are refined by ICP.")
        .param("icp_distance", &Params::icp_distance, "x resolution",
               "Search radius of ICP's first iteration; it shrinks to inlier_distance.",
               graph::in_range(0.1, 100))
        .param("icp_iterations", &Params::icp_iterations, "", "Iterations of ICP, at most.",
               graph::in_range(1, 1000))
        .param("inlier_distance", &Params::inlier_distance, "x resolution",
               "A model point with a scan point this near is supported.", graph::in_range(0.1, 100))
        .param("explained_distance", &Params::explained_distance, "x resolution",
               "Scan points this near to a detection are taken out.", graph::in_range(0.1, 100));

}  // namespace
}  // namespace posevote
