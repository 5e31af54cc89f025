// SPDX-License-Identifier: BSD-3-Clause
// The scan's points around a posed model, and where they lie on it.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// So many of them are worth a task: each takes a search.
constexpr std::size_t kPointsGrain = 256;

/// Rows of the scan's points that nothing explained yet, nearer than `reach` to a place [m].
std::vector<Eigen::Index> rows_near(const Sought& sought, const Eigen::Vector3d& place,
                                    double reach);

/// One of the scan's points, from the nearest of a posed model's.
struct OnModel {
  Eigen::Index row = 0;                            ///< of the model's
  Eigen::Vector3f away = Eigen::Vector3f::Zero();  ///< from there to it, in the model's frame [m]
  float height = 0;                                ///< of that, along the model's normal
  bool normals_agree = false;
};

/// Of this row of the scan; none where the model is farther than `most` [m].
std::optional<OnModel> find_on_model(const Sought& sought, const Eigen::Isometry3f& T_model_scene,
                                     Eigen::Index row, float most);

}  // namespace posevote::poses
