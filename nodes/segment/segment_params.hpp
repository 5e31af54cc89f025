// SPDX-License-Identifier: BSD-3-Clause
// The parameters that every segmentation shares, whatever proposes the poses.
#pragma once

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/segment/find_instances.hpp"

namespace posevote::segment {

constexpr float kRunnerUpRadius = 0.2F;  // x diagonal; part of what runner_up_density means

struct SegmentParams {
  int max_instances = 1;
  int candidates = 1000;
  double nms = 0.1;
  double min_density = 3;
  double min_score = 0.3;
  bool refine = true;
  double icp_distance = 5;
  int icp_iterations = 40;
  double inlier_distance = 2;
  double explained_distance = 3;
  double max_residual = 1.5;
};

/// The lengths for one object [m].
InstanceParams instance_params(const SegmentParams& params, const Model& model, float resolution);

/// Densities are for the caller to fill in.
Detection make_detection(const Model& model, const Candidate& candidate);

/// Throws std::runtime_error where the resolution is no length, or points lack normals.
void check_scan(const FeatureSet& scene_features, const Cloud& scene_cloud, const Scale& scale);
void check_model(const Model& model);

/// Registers them all.
template <class Registration>
Registration with_segment_params(Registration node) {
  using P = SegmentParams;
  node.param("max_instances", &P::max_instances, "", "Instances per object, at most.",
             graph::in_range(1, 1000));
  node.param("candidates", &P::candidates, "",
             "Densest modes of which the instances are chosen; 1: the densest, as in the paper.",
             graph::in_range(1, 10000));
  node.param("nms", &P::nms, "x diagonal",
             "Instances of one object lie farther apart than this share of its bounding box.",
             graph::in_range(0, 10));
  node.param("min_density", &P::min_density, "votes",
             "A mode of lower density (of the votes that are left) is not tried.",
             graph::at_least(0));
  node.param("min_score", &P::min_score, "", "Detections of lower score are rejected.",
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
  node.param("max_residual", &P::max_residual, "x usual",
             "An instance that leaves more than this many times the residual of the scan's others "
             "loses score by the square: a look-alike. 0: none does.",
             graph::in_range(0, 1000));
  return node;
}

}  // namespace posevote::segment
