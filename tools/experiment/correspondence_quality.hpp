// SPDX-License-Identifier: BSD-3-Clause
// How good matches and normals of a scan were, by its true pose.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/nearest_index.hpp"

namespace posevote {

struct CorrespondenceQuality {
  std::size_t count = 0;
  double inlier_rate = 0;  ///< share whose two points lie within `radius` under the true pose
  double normal_deg = 0;   ///< mean angle of scene normals to the model's at the same place [deg]
};

/// Judges the tables of `write_correspondences` against a model with normals.
class CorrespondenceJudge {
 public:
  CorrespondenceJudge(Cloud model, double radius);

  /// Throws std::runtime_error "file:line: ..." for a row that is no correspondence.
  CorrespondenceQuality judge(const std::filesystem::path& csv,
                              const Eigen::Isometry3d& T_scene_model) const;

 private:
  Cloud model_;
  double radius_;
  geometry::NearestIndex index_;
};

}  // namespace posevote
