// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/scan_hash.hpp"

#include <stdexcept>
#include <vector>

#include "nodes/formats/format.hpp"
#include "nodes/formats/paint_files.hpp"
#include "nodes/formats/sensor_pose.hpp"
#include "nodes/library/content_hash.hpp"

namespace posevote::formats {

namespace fs = std::filesystem;

std::string hash_scan(const SceneFile& scan) {
  if (scan.points || scan.depth) return "";
  if (const Format* format = find_format(scan.path); format && format->entry)
    return library::checksum(format->entry(scan.path));
  std::vector<fs::path> files{scan.path};
  const fs::path pose = pose_file_of(scan.path);
  std::error_code is_loop;
  if (fs::exists(fs::symlink_status(pose, is_loop))) files.push_back(pose);
  if (!scan.color.empty()) files.push_back(scan.color);
  for (fs::path& paint : paint_files(scan.path)) files.push_back(std::move(paint));
  return library::hash_files(files, "");
}

std::string hash_or_unknown(const SceneFile& scan) try {
  return hash_scan(scan);
} catch (const std::runtime_error&) {
  return "";
}

}  // namespace posevote::formats
