// SPDX-License-Identifier: BSD-3-Clause
// Proposed poses: modes of a vote density, or what a rival of pose voting (RANSAC, Hough space,
// point-pair features ...) comes up with.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <vector>

#include "nodes/data/model.hpp"

namespace posevote {

/// A pose as votes express it.
struct Hypothesis {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< where the model's centre lands [m]
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  /// What speaks for it before anything is judged: its density, or what the method counts.
  double support = 0;
};

/// Of one object, in descending order of support.
struct Hypotheses {
  std::shared_ptr<const Model> model;
  std::vector<Hypothesis> items;
};

/// Equals stay in their order.
inline void sort_by_support(std::vector<Hypothesis>& items) {
  std::stable_sort(items.begin(), items.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.support > b.support; });
}

/// Where a posed model's centre lands [m].
inline Eigen::Vector3d posed_center(const Eigen::Isometry3d& T_scene_model,
                                    const Eigen::Vector3f& model_center) {
  return T_scene_model * model_center.cast<double>();
}

inline Hypothesis hypothesis_of(const Eigen::Isometry3d& T_scene_model,
                                const Eigen::Vector3f& model_center, double support) {
  return {posed_center(T_scene_model, model_center).cast<float>(),
          Eigen::Quaternionf(T_scene_model.linear().cast<float>()), support};
}

/// And back: x -> R (x - c) + t for the model's centre c, so the translation is t - R c.
inline Eigen::Isometry3d T_scene_model_of(const Hypothesis& pose,
                                          const Eigen::Vector3f& model_center) {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  T_scene_model.linear() = pose.rotation.cast<double>().normalized().toRotationMatrix();
  T_scene_model.translation() =
      pose.center.cast<double>() - T_scene_model.linear() * model_center.cast<double>();
  return T_scene_model;
}

}  // namespace posevote
