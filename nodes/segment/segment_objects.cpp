// SPDX-License-Identifier: BSD-3-Clause
// Greedy segmentation of a scan into objects (Buch, Kiforenko, Kraft, ICCV 2017, section 4): objects in
// descending number of correspondences; for each the densest pose vote, shifted to its neighbourhood's
// mean, refined by ICP, judged by what the sensor measured, and the scan points it explains taken out
// before the next mode is sought. Correspondences that start at explained points are taken out of all
// objects; their votes are subtracted from the densities, which equals voting anew without them.
// Many instances of an object: the best vote of each correspondence, thinned by non-maximum
// suppression. Cost: per mode tried a few neighbourhood queries, one ICP and one fit measure.
// A scan without votes gives no detections; that is no failure.
//
//   segment_objects: {in: [votes, densities, scene_features, scene_cloud, scale], out: detections,
//                     max_instances: 1}
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/segment/explain_points.hpp"
#include "nodes/segment/find_modes.hpp"
#include "nodes/segment/icp.hpp"
#include "nodes/segment/live_votes.hpp"
#include "nodes/segment/measure_fit.hpp"
#include "nodes/segment/refine_mode.hpp"

namespace posevote {
namespace {

constexpr float kSearchCell = 2;        // x resolution
constexpr double kKeptSupport = 0.95;  // ICP may lose a few chance partners at the silhouette, no more
constexpr float kRunnerUpRadius = 0.2F;  // x diagonal; part of what runner_up_density means

struct Params {
  int max_instances = 1;
  int spare_candidates = 4;
  double nms = 0.2;
  double min_density = 3;
  double min_score = 0.1;
  bool refine = true;
  double icp_distance = 5;
  int icp_iterations = 40;
  double inlier_distance = 2;
  double explained_distance = 3;
};

/// The scan as the segmentation goes on.
struct Scene {
  const Cloud& cloud;
  const FeatureSet& features;
  float resolution;
  RangeView view;
  std::vector<char> explained;          // per scan point
  std::vector<char> feature_explained;  // per scene feature
  ScanSurface surface;

  Scene(const Cloud& scan, const FeatureSet& scan_features, float resolution_m)
      : cloud(scan),
        features(scan_features),
        resolution(resolution_m),
        view(scan, resolution_m),
        explained(static_cast<std::size_t>(scan.points.rows()), 0),
        feature_explained(static_cast<std::size_t>(scan_features.points.rows()), 0),
        surface(scan, explained, view.usable(), kSearchCell * resolution_m) {}
};

/// Objects in descending number of correspondences; equals in ascending obj_id, then as given.
std::vector<std::size_t> order_objects(const PerObject<VoteSet>& votes) {
  std::vector<std::size_t> order(votes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&votes](std::size_t a, std::size_t b) {
    const std::size_t count_a = votes[a].scene_feature.size();
    const std::size_t count_b = votes[b].scene_feature.size();
    return count_a != count_b ? count_a > count_b
                              : votes[a].model->obj_id < votes[b].model->obj_id;
  });
  return order;
}

/// The refined pose of a mode; that of ICP only where it keeps the mode's support.
struct Candidate {
  PoseMode mode;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Fit fit;
};

Candidate refine_candidate(const LiveVotes& object, std::uint32_t vote, const Scene& scene,
                           const Params& params) {
  const Model& model = *object.votes->model;
  const auto tolerance = static_cast<float>(params.inlier_distance) * scene.resolution;
  Candidate candidate;
  candidate.mode = refine_mode(*object.votes, *object.raw, object.alive,
                               vote_pose(*object.votes, vote));
  candidate.T_scene_model = T_scene_model_of(candidate.mode, model.center);
  candidate.fit = measure_fit(model.cloud, scene.surface, scene.view, candidate.T_scene_model,
                              tolerance);
  if (!params.refine) return candidate;
  const IcpParams icp_params{params.icp_iterations,
                             static_cast<float>(params.icp_distance) * scene.resolution,
                             tolerance};
  const Eigen::Isometry3d T_refined =
      icp(model.cloud, scene.surface, candidate.T_scene_model, icp_params);
  const Fit refined = measure_fit(model.cloud, scene.surface, scene.view, T_refined, tolerance);
  const auto fewest = kKeptSupport * static_cast<double>(candidate.fit.supported);
  if (static_cast<double>(refined.supported) < fewest) return candidate;
  candidate.T_scene_model = T_refined;
  candidate.fit = refined;
  return candidate;
}

Detection make_detection(const LiveVotes& object, const Candidate& candidate) {
  const Model& model = *object.votes->model;
  Detection detection;
  detection.obj_id = model.obj_id;
  detection.model = model.name;
  detection.score = fit_score(candidate.fit);
  detection.density = raw_density(*object.raw, candidate.mode);
  detection.runner_up_density =
      runner_up_density(*object.votes, object.raw->density, candidate.mode.center,
                        kRunnerUpRadius * model.diagonal);
  detection.inlier_fraction = candidate.fit.inlier_fraction;
  detection.rmse = candidate.fit.rmse;
  detection.T_scene_model = candidate.T_scene_model;
  return detection;
}

/// Takes what a detection explains out of the scan.
void take_out(Scene& scene, const Model& model, const Eigen::Isometry3d& T_scene_model,
              const Params& params) {
  const auto distance = static_cast<float>(params.explained_distance) * scene.resolution;
  const PointGrid grid(model.cloud.points, distance);
  const auto merge = [&](std::vector<char>& so_far, const PointMatrix& points,
                         const PointMatrix& normals) {
    const std::vector<char> now =
        explain_points(model.cloud, grid, T_scene_model, points, normals, distance);
    for (std::size_t i = 0; i < now.size(); ++i)
      so_far[i] = static_cast<char>(so_far[i] | now[i]);
  };
  merge(scene.explained, scene.cloud.points, scene.cloud.normals);
  merge(scene.feature_explained, scene.features.points, scene.features.normals);
  scene.surface = ScanSurface(scene.cloud, scene.explained, scene.view.usable(),
                              kSearchCell * scene.resolution);
}

/// All instances of one object.
void find_instances(LiveVotes& object, Scene& scene, const Params& params, Detections& found) {
  const Model& model = *object.votes->model;
  const auto radius = static_cast<float>(params.nms) * model.diagonal;
  std::vector<Eigen::Vector3f> taken;
  int instances = 0;
  for (int tries = params.max_instances + params.spare_candidates;
       tries > 0 && instances < params.max_instances; --tries) {
    remove_explained(object, scene.feature_explained);
    const std::vector<std::uint32_t> candidates = best_votes(*object.votes, object.density);
    const auto vote = next_mode(*object.votes, candidates, taken, radius);
    if (!vote || object.density[*vote] < params.min_density) return;
    const Candidate candidate = refine_candidate(object, *vote, scene, params);
    taken.push_back(candidate.mode.center);
    if (fit_score(candidate.fit) < params.min_score) continue;
    found.items.push_back(make_detection(object, candidate));
    ++instances;
    take_out(scene, model, candidate.T_scene_model, params);
  }
}

Detections segment_objects(const PerObject<VoteSet>& votes, const PerObject<VoteDensity>& densities,
                           const FeatureSet& scene_features, const Cloud& scene_cloud,
                           const Scale& scale, const Params& params) {
  check_inputs(votes, densities, scene_features, scale);
  Scene scene(scene_cloud, scene_features, scale.resolution);
  Detections found;
  for (const std::size_t i : order_objects(votes)) {
    LiveVotes object = all_votes(votes[i], densities[i]);
    find_instances(object, scene, params, found);
  }
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
        .param("spare_candidates", &Params::spare_candidates, "",
               "Modes per object that may fail before it is given up.", graph::in_range(0, 1000))
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
               "A model point with a scan point this near is supported.",
               graph::in_range(0.1, 100))
        .param("explained_distance", &Params::explained_distance, "x resolution",
               "Scan points this near to a detection are taken out.", graph::in_range(0.1, 100));

}  // namespace
}  // namespace posevote
