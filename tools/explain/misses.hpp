// SPDX-License-Identifier: BSD-3-Clause
// What a whole run missed, by the data set's true poses, and why: how often each cause, and how far
// the causes that are named without a true pose can be believed.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "nodes/layouts/ground_truth.hpp"
#include "tools/explain/explain.hpp"

namespace posevote::explain {

struct Miss {
  std::string scene, model;
  int obj_id = 0;
  Verdict named;  ///< without the true pose
  Verdict truth;  ///< by it
  bool is_confirmed = false;
};

/// Whether the true pose bears out what was named without it: the same cause, and the same stage
/// unless the candidate was the object; "no trace", where its features or matches give too little.
bool is_confirmed(const Explained& one);

/// The misses of a run in the order of its scans, up to the scan with which there are `most`.
/// Instances that `evaluate` does not count are none.
std::vector<Miss> misses_of(const Run& run, const layouts::GroundTruth& truth,
                            const Request& request, std::size_t most);

std::string to_text(const std::vector<Miss>& misses);
nlohmann::ordered_json to_json(const std::vector<Miss>& misses);

/// The true poses of one image, by obj_id.
std::map<int, std::vector<Eigen::Isometry3d>> poses_of(const layouts::GroundTruth& truth,
                                                       const layouts::ImageKey& image);

}  // namespace posevote::explain
