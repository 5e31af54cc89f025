// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/adapters/pcl_grouping.hpp"

#include <pcl/console/print.h>
#include <pcl/correspondence.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace posevote::adapters {

namespace {

/// PCL says on stderr that a group of three has no consensus: no news to anybody.
[[maybe_unused]] const bool is_quiet =
    (pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS), true);

}  // namespace

PclPairs make_pcl_pairs(const Correspondences& matches, const FeatureSet& scene) {
  using Points = pcl::PointCloud<pcl::PointXYZ>;
  PclPairs out{std::make_shared<Points>(), std::make_shared<Points>(),
               std::make_shared<pcl::Correspondences>()};
  for (std::size_t i = 0; i < matches.scene_feature.size(); ++i) {
    const Eigen::RowVector3f m = matches.model->features.points.row(matches.model_feature[i]);
    const Eigen::RowVector3f s = scene.points.row(matches.scene_feature[i]);
    out.model->emplace_back(m.x(), m.y(), m.z());
    out.scene->emplace_back(s.x(), s.y(), s.z());
    const auto k = static_cast<int>(i);
    out.pairs->emplace_back(k, k, matches.distance[i]);
  }
  return out;
}

Hypotheses make_hypotheses(const Correspondences& matches, const PclPoses& poses,
                           const std::vector<pcl::Correspondences>& groups) {
  Hypotheses found{matches.model, {}};
  for (std::size_t i = 0; i < poses.size() && i < groups.size(); ++i) {
    const Eigen::Isometry3d T_scene_model(poses[i].cast<double>());
    const Eigen::Matrix3d R = T_scene_model.linear();
    if (!T_scene_model.matrix().allFinite() || !R.isUnitary(1e-3) || R.determinant() < 0) continue;
    found.items.push_back(
        hypothesis_of(T_scene_model, matches.model->center, static_cast<double>(groups[i].size())));
  }
  sort_by_support(found.items);
  return found;
}

}  // namespace posevote::adapters
