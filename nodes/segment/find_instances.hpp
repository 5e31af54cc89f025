// SPDX-License-Identifier: BSD-3-Clause
// From many proposed poses of one object to its instances: each time the pose that agrees best with
// the scan, refined by ICP, whose points then are taken out of the scan. Whatever proposes poses
// (votes, RANSAC, a Hough space) is judged by the same rules.
#pragma once

#include <functional>
#include <vector>

#include "nodes/segment/find_modes.hpp"
#include "nodes/segment/measure_fit.hpp"
#include "nodes/segment/scan_state.hpp"

namespace posevote {

struct InstanceParams {
  int max_instances = 1;
  double min_score = 0;
  float nms_radius = 0;          ///< between the centres of instances [m]
  bool refine = true;            ///< by ICP
  int icp_iterations = 40;       ///< at most
  float icp_distance = 0;        ///< search radius of the first iteration [m]
  float tolerance = 0;           ///< of support [m]
  float explained_distance = 0;  ///< scan points this near to an instance are taken out [m]
};

/// Where poses come from.
struct Proposals {
  /// Poses to judge, given what of the scan is explained and the centres that are taken.
  std::function<std::vector<PoseMode>(const ScanState& scan,
                                      const std::vector<Eigen::Vector3f>& taken)>
      propose;
  /// Makes the pose of a proposal on the short list better, before ICP; its support stays.
  std::function<PoseMode(const PoseMode& mode)> improve;
};

/// A pose of the object, and how it fits.
struct Candidate {
  PoseMode mode;  ///< before ICP
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Fit fit;
  double score = 0;
  double rank = 0;  ///< by which poses are chosen: the score, a little lower for less support
};

/// The instances in the order in which they were found; of equally good poses the one that was
/// proposed first. Takes what they explain out of the scan.
std::vector<Candidate> find_instances(const Model& model, const Proposals& proposals,
                                      const InstanceParams& params, ScanState& scan);

}  // namespace posevote
