// SPDX-License-Identifier: BSD-3-Clause
// The folder of a run, before its first frame and after its last.
#pragma once

#include <vector>

#include "tools/manifest/manifest.hpp"

namespace posevote {

/// Folders that writers fill, a few files for each frame.
inline constexpr const char* kFoldersOfFrames[] = {"pictures", "overlays", "correspondences"};

/// Takes away what a run writes, and nothing else that may lie there.
void remove_run(const std::filesystem::path& out);

/// Makes the manifest, effective.yaml and the files for the results in command.out. With --resume
/// goes on with the run that is there, and leaves out of `scenes`, those of this start's shard, what
/// it has answered. Throws std::invalid_argument that says what differs where it is another run, and
/// std::runtime_error where a file cannot be read or written.
void begin_run(const RunCommand& command, const Configuration& configuration,
               const ModelLibrary& library, Manifest manifest, std::vector<SceneEntry>& scenes);

/// Puts the results in the order of the scans. Where that cannot be done, it is told, and what has
/// been written stays.
void finish_run(const RunCommand& command, const Configuration& configuration);

}  // namespace posevote
