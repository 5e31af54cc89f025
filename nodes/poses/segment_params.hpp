// SPDX-License-Identifier: BSD-3-Clause
// The parameters that every segmentation shares, whatever proposes the poses.
#pragma once

#include <functional>

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/poses/find_instances.hpp"

namespace posevote::poses {

struct SegmentParams {
  int max_instances = 20;
  int candidates = 4000;
  double nms = 0.1;
  double overlap = 0.1;
  double min_confidence = 0.5;
  double min_score = 0.1;
  bool refine = true;
  double icp_distance = 5;
  int icp_iterations = 40;
  double inlier_distance = 2;
  double explained_distance = 3;
  double max_residual = 1;
  Terms terms;
};

/// The lengths for one object [m]: multiples of the scan's resolution, or of the model's where that
/// is coarser.
InstanceParams instance_params(const SegmentParams& params, const Model& model,
                               float scan_resolution);

/// Densities are for the caller to fill in.
Detection make_detection(const Model& model, const Candidate& candidate,
                         const ConfidenceTerms& terms);

/// The same of all, those that were rejected with the reason; `make`: of an Instance.
Detections make_detections(const Instances& instances, const SegmentParams& params,
                           const std::function<Detection(const Instance&)>& make);

/// Throws std::runtime_error where the resolution is no length, or points lack normals.
void check_scan(const FeatureSet& scene_features, const Cloud& scene_cloud, const Scale& scale);
void check_model(const Model& model);

/// Registers them all, the terms for experts.
graph::Registration<SegmentParams> with_segment_params(graph::Registration<SegmentParams> node);

/// The terms alone (term_params.cpp).
void add_terms(graph::Registration<SegmentParams>& node);

}  // namespace posevote::poses
