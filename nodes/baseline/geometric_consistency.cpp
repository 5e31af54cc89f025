// SPDX-License-Identifier: BSD-3-Clause
// Geometric consistency grouping (Chen, Bhanu 2007; PCL's code): correspondences whose mutual
// distances agree on model and scene form a group, each group gives a pose.
//
// A group begins at each correspondence that is in none yet and takes all that are consistent with
// every member so far: O(correspondences x group size). PCL fits the pose with a RANSAC of fixed
// seed.
//
//   geometric_consistency: {in: [correspondences, scene_features, scale], out: hypotheses}
#include <pcl/recognition/cg/geometric_consistency.h>

#include "graph/registry.hpp"
#include "nodes/adapters/pcl_grouping.hpp"

namespace posevote::baseline {
namespace {

struct Params {
  double size = 5;
  int least = 5;
};

Hypotheses geometric_consistency(const Correspondences& matches, const FeatureSet& scene,
                                 const Scale& scale, const Params& params) {
  const adapters::PclPairs pairs = adapters::make_pcl_pairs(matches, scene);
  if (pairs.pairs->size() < 3) return {matches.model, {}};
  pcl::GeometricConsistencyGrouping<pcl::PointXYZ, pcl::PointXYZ> grouping;
  grouping.setGCSize(params.size * static_cast<double>(scale.resolution));
  grouping.setGCThreshold(params.least);
  grouping.setInputCloud(pairs.model);
  grouping.setSceneCloud(pairs.scene);
  return group(grouping, pairs, matches);
}

const auto registered =
    graph::register_node("geometric_consistency", geometric_consistency,
                         "Rival: poses of groups of correspondences with equal mutual distances.")
        .input("correspondences")
        .input("scene_features")
        .input("scale")
        .output("hypotheses")
        .param("size", &Params::size, "x resolution",
               "By how much distances within a group may differ.", graph::greater_than(0))
        .param("least", &Params::least, "", "Correspondences in a group, at least.",
               graph::at_least(3));

}  // namespace
}  // namespace posevote::baseline
