// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/segment_params.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace posevote::segment {
namespace {

/// A point set without a normal for each point is refused; a normal of length 0 is not.
void check_normals(const std::string& what, const PointMatrix& points, const PointMatrix& normals) {
  if (normals.rows() == points.rows()) return;
  throw std::runtime_error(what + " has " + std::to_string(points.rows()) + " points but " +
                           std::to_string(normals.rows()) + " normals");
}

}  // namespace

InstanceParams instance_params(const SegmentParams& params, const Model& model, float resolution) {
  const auto length = [&](double multiple) { return static_cast<float>(multiple) * resolution; };
  InstanceParams out;
  out.max_instances = params.max_instances;
  out.candidates = static_cast<std::size_t>(params.candidates);
  out.min_score = params.min_score;
  out.nms_radius = static_cast<float>(params.nms) * model.diagonal;
  out.refine = params.refine;
  out.icp_iterations = params.icp_iterations;
  out.icp_distance = length(params.icp_distance);
  out.tolerance = length(params.inlier_distance);
  out.explained_distance = length(params.explained_distance);
  out.max_residual = params.max_residual;
  return out;
}

Detection make_detection(const Model& model, const Candidate& candidate) {
  Detection detection;
  detection.obj_id = model.obj_id;
  detection.model = model.name;
  detection.score = candidate.confidence();
  detection.inlier_fraction = candidate.fit.inlier_fraction;
  detection.rmse = candidate.fit.rmse;
  detection.T_scene_model = candidate.T_scene_model;
  return detection;
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
  for (const NearSymmetry& one : model.near_symmetries.items)
    if (!one.is_within(model.cloud.points.rows()))
      throw std::runtime_error("model " + model.name + " has " +
                               std::to_string(model.cloud.points.rows()) +
                               " points, but its near symmetries are of a cloud with more");
}

}  // namespace posevote::segment
