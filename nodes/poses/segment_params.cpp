// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/segment_params.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "nodes/poses/confidence.hpp"

namespace posevote::poses {
namespace {

/// A point set without a normal for each point is refused; a normal of length 0 is not.
void check_normals(const std::string& what, const PointMatrix& points, const PointMatrix& normals) {
  if (normals.rows() == points.rows()) return;
  throw std::runtime_error(what + " has " + std::to_string(points.rows()) + " points but " +
                           std::to_string(normals.rows()) + " normals");
}

std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::string why_rejected(const Detection& rejected, const SegmentParams& params) {
  if (rejected.score < params.min_score)
    return "score " + two_digits(rejected.score) + " is below min_score " +
           two_digits(params.min_score);
  return "confidence " + two_digits(rejected.confidence) + " is below min_confidence " +
         two_digits(params.min_confidence);
}

}  // namespace

InstanceParams instance_params(const SegmentParams& params, const Model& model,
                               float scan_resolution) {
  const float coarser = std::max(scan_resolution, model.resolution);
  const auto length = [&](double multiple) { return static_cast<float>(multiple) * coarser; };
  InstanceParams out;
  out.max_instances = params.max_instances;
  out.candidates = static_cast<std::size_t>(params.candidates);
  out.min_score = params.min_score;
  out.min_confidence = params.min_confidence;
  out.nms_radius = static_cast<float>(params.nms) * model.diagonal;
  out.overlap = params.overlap;
  out.refine = params.refine;
  out.icp_iterations = params.icp_iterations;
  out.icp_distance = length(params.icp_distance);
  out.tolerance = length(params.inlier_distance);
  out.explained_distance = length(params.explained_distance);
  out.max_residual = params.max_residual;
  return out;
}

Detection make_detection(const Model& model, const Candidate& candidate,
                         const ConfidenceTerms& terms) {
  Detection detection;
  detection.obj_id = model.obj_id;
  detection.model = model.name;
  detection.score = candidate.score();
  detection.confidence = candidate.confidence;
  detection.look_alikes = candidate.look_alikes;
  detection.identity = candidate.identity;
  detection.clues = candidate.clues;
  detection.against = against(candidate.clues, terms);
  detection.inlier_fraction = candidate.fit.inlier_fraction;
  detection.rmse = candidate.fit.rmse;
  detection.T_scene_model = candidate.T_scene_model;
  detection.covariance = candidate.covariance;
  detection.seconds = candidate.seconds;
  detection.symmetries = candidate.symmetries.value_or(model.symmetries);
  detection.colors = candidate.color_clues;
  return detection;
}

Detections make_detections(const Instances& instances, const SegmentParams& params,
                           const std::function<Detection(const Instance&)>& make) {
  Detections detections;
  for (const Instance& instance : instances.found) detections.items.push_back(make(instance));
  for (const Instance& instance : instances.rejected) {
    Detection& rejected = detections.rejected.emplace_back(make(instance));
    rejected.why = why_rejected(rejected, params);
  }
  return detections;
}

void check_scan(const FeatureSet& scene_features, const Cloud& scene_cloud, const Scale& scale) {
  if (!(scale.resolution > 0) || !std::isfinite(scale.resolution))
    throw std::runtime_error("resolution is " + std::to_string(scale.resolution) +
                             " m, expected more than 0");
  check_normals("the scan", scene_cloud.points, scene_cloud.normals);
  check_normals("the feature set", scene_features.points, scene_features.normals);
}

void check_model(const Model& model) {
  check_normals("model " + model.name, model.cloud.points, model.cloud.normals);
  if (model.outline.ends.size() != static_cast<std::size_t>(model.cloud.points.rows()))
    throw std::runtime_error("model " + model.name + " has " +
                             std::to_string(model.cloud.points.rows()) + " points but " +
                             std::to_string(model.outline.ends.size()) + " in its outline");
  if (model.outline.hull.cols() == 0)
    throw std::runtime_error("model " + model.name + " has no outermost points in its outline");
  for (const NearSymmetry& one : model.near_symmetries.items)
    if (!one.is_within(model.cloud.points.rows()))
      throw std::runtime_error("model " + model.name + " has " +
                               std::to_string(model.cloud.points.rows()) +
                               " points, but its near symmetries are of a cloud with more");
}

graph::Registration<SegmentParams> with_segment_params(graph::Registration<SegmentParams> node) {
  using P = SegmentParams;
  node.param("max_instances", &P::max_instances, "", "Instances per object, at most.",
             graph::in_range(1, 1000));
  node.param("candidates", &P::candidates, "",
             "Densest modes of which the instances are chosen; 1: the densest, as in the paper.",
             graph::in_range(1, 10000));
  node.param("nms", &P::nms, "x diagonal",
             "Instances of one object lie farther apart than this share of its bounding box.",
             graph::in_range(0, 10));
  node.param("overlap", &P::overlap, "x surface",
             "Bodies are solid: of an instance at most this share lies in those that were found "
             "before. 1: any.",
             graph::in_range(0, 1));
  node.param("min_confidence", &P::min_confidence, "",
             "Detections that are right with less probability are rejected.",
             graph::in_range(0, 1));
  node.param("min_score", &P::min_score, "",
             "Poses of lower score are not worth a look, whatever their confidence.",
             graph::in_range(0, 1));
  node.param("refine", &P::refine, "", "Whether modes are refined by ICP.");
  node.param("icp_distance", &P::icp_distance, "x resolution",
             "Search radius of ICP's first iteration; it shrinks to inlier_distance.",
             graph::in_range(0.1, 100));
  node.param("icp_iterations", &P::icp_iterations, "", "Iterations of ICP, at most.",
             graph::in_range(1, 1000));
  node.param("inlier_distance", &P::inlier_distance, "x resolution",
             "A model point with a scan point this near is supported.", graph::in_range(0.1, 100));
  node.param("explained_distance", &P::explained_distance, "x resolution",
             "Scan points this near to a detection are taken out.", graph::in_range(0.1, 100));
  node.param(
      "max_residual", &P::max_residual, "x usual",
      "An instance of which whole patches lie off by more than this many times what they do of "
      "the scan's others is less exact, and loses score: a look-alike. 0: none is.",
      graph::in_range(0, 1000));
  add_terms(node);
  return node;
}

}  // namespace posevote::poses
