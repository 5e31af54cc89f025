// SPDX-License-Identifier: BSD-3-Clause
// The scans of the sensitivity experiment: copies of a model under noise and a random pose.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// One scan: the model's points displaced in uniform directions by lengths uniform up to
/// `noise` x the model's diagonal, then moved by a random pose. Made from its seed alone.
struct NoisyCopy {
  double noise = 0;  ///< fraction of the bounding-box diagonal
  int seed = 1;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  std::filesystem::path file;
};

/// Copies at each of `levels` (ascending, in 0.1 % of the diagonal), `seeds` of each, in the order
/// in which a run over `folder` reads them. Writes the files that are not there yet.
std::vector<NoisyCopy> make_noisy_copies(const Cloud& model, const std::filesystem::path& folder,
                                         const std::vector<int>& levels, int seeds);

}  // namespace posevote
