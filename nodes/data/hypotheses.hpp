// SPDX-License-Identifier: BSD-3-Clause
// Poses that a rival of pose voting (RANSAC, Hough space, point-pair features ...) proposes.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <vector>

#include "nodes/data/model.hpp"

namespace posevote {

struct Hypothesis {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();  ///< [m]
  double support = 0;  ///< what the method counts: inliers, Hough votes ...
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

}  // namespace posevote
