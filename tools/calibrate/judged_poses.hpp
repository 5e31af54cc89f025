// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/data/clues.hpp"

namespace posevote {

/// A detection of a run, with what its confidence was made from.
struct JudgedPose {
  std::pair<int, int> image;  ///< scene_id, im_id
  Clues clues{};
  std::optional<ColorClues> colors{};
  bool right = false;
};

/// The detections of a run's folder, judged against the true poses of its data set; without those
/// of instances that do not count. Throws std::invalid_argument where results.json has no clues.
std::vector<JudgedPose> judge_poses(const std::filesystem::path& run,
                                    const std::filesystem::path& dataset, const std::string& rule);

}  // namespace posevote
