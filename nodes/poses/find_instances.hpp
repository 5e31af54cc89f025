// SPDX-License-Identifier: BSD-3-Clause
// From proposed poses of several objects to what is in the scan: each time the pose that agrees
// best, of whatever object, whose points then are taken out of the scan.
#pragma once

#include <vector>

#include "nodes/poses/object_search.hpp"

namespace posevote::poses {

struct Instance {
  std::size_t object = 0;  ///< index of its search
  Candidate candidate;
  bool is_chosen = true;  ///< doubtful or not, it took its points; else it convinced nobody
};

/// What became of the best poses.
struct Instances {
  std::vector<Instance> found;     ///< in descending order of confidence
  std::vector<Instance> rejected;  ///< the same; a few of each object, which missed a threshold
};

/// Instance after instance; of equally good poses that of the lower obj_id goes first, then the one
/// that was proposed first. Takes what they explain out of the scan, but for
/// the last where no more may be found. A wrong object that fits a part of another one's points so
/// does not get them before the right one.
Instances find_instances(std::vector<ObjectSearch>& searches, ScanState& scan);

}  // namespace posevote::poses
