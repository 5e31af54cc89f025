// SPDX-License-Identifier: BSD-3-Clause
// What the rivals that PCL groups correspondences for share.
#pragma once

#include <Eigen/StdVector>
#include <memory>
#include <vector>

#include "nodes/data/hypotheses.hpp"

namespace pcl {
template <class Point>
class PointCloud;
struct PointXYZ;
struct Correspondence;
using Correspondences = std::vector<Correspondence, Eigen::aligned_allocator<Correspondence>>;
}  // namespace pcl

namespace posevote::adapters {

/// The ends of correspondences as clouds of their own: correspondence i joins point i of each.
struct PclPairs {
  std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> model, scene;
  std::shared_ptr<pcl::Correspondences> pairs;
};

PclPairs make_pcl_pairs(const Correspondences& matches, const FeatureSet& scene);

using PclPoses = std::vector<Eigen::Matrix4f, Eigen::aligned_allocator<Eigen::Matrix4f>>;

/// Each pose with the size of its group as support. Poses that are no rotation are left out.
Hypotheses make_hypotheses(const Correspondences& matches, const PclPoses& poses,
                           const std::vector<pcl::Correspondences>& groups);

/// What a grouping of PCL's, whose clouds are set, makes of the pairs. (Groups is a parameter, so
/// that PCL's types need not be complete here.)
template <class Grouping, class Groups = std::vector<pcl::Correspondences>>
Hypotheses group(Grouping& grouping, const PclPairs& pairs, const Correspondences& matches) {
  grouping.setModelSceneCorrespondences(pairs.pairs);
  PclPoses poses;
  Groups groups;
  grouping.recognize(poses, groups);
  return make_hypotheses(matches, poses, groups);
}

}  // namespace posevote::adapters
