// SPDX-License-Identifier: BSD-3-Clause
// Folders of depth images with what they need beside them, or files of many, as recorders write them:
// what `run --scenes` takes, with no models and no truth. A kind of recording is registered with one
// expression and named nowhere else: bop.cpp, sixd.cpp, depth_folder.cpp, rosbag.cpp, tum.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"

namespace posevote::layouts {

struct Recording {
  std::string name;
  std::string expected;  ///< the files that make one
  std::function<bool(const std::filesystem::path& path)> recognises;
  /// In the order of time, with their cameras; scene_id and im_id mean nothing. Throws
  /// std::runtime_error naming a file that is missing or malformed.
  std::function<std::vector<SceneFile>(const std::filesystem::path& path)> frames;
};

/// Throws std::logic_error where another has that name. The value means nothing: it lets a file
/// register as it is initialised.
bool register_recording(const Recording& recording);

/// Of those that recognise a folder, or a file of many images or what is in it, the first by name;
/// null where none does.
const Recording* find_recording(const std::filesystem::path& path);

}  // namespace posevote::layouts
