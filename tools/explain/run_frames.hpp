// SPDX-License-Identifier: BSD-3-Clause
// The frames of a run, answered or failed, and which of them a user means.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace posevote::explain {

/// The frame of a run by its name, file, number, or SCENE/IMAGE of a data set.
struct FrameOfRun {
  std::size_t number = 0;
  std::string name;
  std::filesystem::path file;
  int scene_id = 0, im_id = 0;
  std::string failed_node, failure;  ///< of one that has no answer
};

/// All frames of a run, answered or failed. Throws std::invalid_argument where the folder holds no
/// run.
std::vector<FrameOfRun> read_run_frames(const std::filesystem::path& out);

/// Throws std::invalid_argument where none or several are meant, with the nearest name.
const FrameOfRun& find_frame(const std::vector<FrameOfRun>& frames, const std::string& scene,
                             const std::filesystem::path& out);

}  // namespace posevote::explain
