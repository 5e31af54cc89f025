// SPDX-License-Identifier: BSD-3-Clause
// The next instance of an object: of its densest modes, the one that agrees best with the scan.
//
// The paper takes the densest. On laser scans that is the right one by a wide margin; on RGB-D
// scans, where tables and walls vote too, right modes are often not the densest, but what the
// sensor measured tells them apart. So unless the densest mode fits beyond doubt as it stands, as
// many modes as asked for are judged at a glance; the best few are refined by ICP, and the best of
// those is chosen.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "nodes/segment/live_votes.hpp"
#include "nodes/segment/measure_fit.hpp"
#include "nodes/segment/refine_mode.hpp"
#include "nodes/segment/scan_state.hpp"

namespace posevote {

struct CandidateParams {
  int candidates = 100;     ///< modes that are judged, at most; 1: the densest, as in the paper
  double min_density = 0;   ///< modes of lower density are not judged
  float nms_radius = 0;     ///< between the centres of modes [m]
  bool refine = true;       ///< by ICP
  int icp_iterations = 40;  ///< at most
  float icp_distance = 0;   ///< search radius of the first iteration [m]
  float tolerance = 0;      ///< of support [m]
};

/// A pose of the object, and how it fits.
struct Candidate {
  PoseMode mode;  ///< before ICP
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Fit fit;
  double score = 0;
};

/// The candidate of highest score whose centre keeps clear of those in `taken`; of equals the
/// denser.
std::optional<Candidate> choose_candidate(const LiveVotes& object, const ScanState& scan,
                                          const std::vector<Eigen::Vector3f>& taken,
                                          const CandidateParams& params);

}  // namespace posevote
