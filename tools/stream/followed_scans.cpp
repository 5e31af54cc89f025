// SPDX-License-Identifier: BSD-3-Clause
#include "tools/stream/followed_scans.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "nodes/formats/format.hpp"
#include "nodes/layouts/camera_file.hpp"
#include "nodes/layouts/recording.hpp"

namespace posevote::stream {
namespace {

namespace fs = std::filesystem;

/// The recording that may grow: each image stands by itself.
constexpr const char* kDepthFolder = "depth images";
constexpr std::chrono::milliseconds kPatience(50);  ///< to look whether the user has had enough

fs::path folder_of_scans(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw std::runtime_error(folder.string() + ": expected a folder to follow");
  const layouts::Recording* recording = layouts::find_recording(folder);
  if (recording && recording->name != kDepthFolder)
    throw std::runtime_error(folder.string() + ": holds a recording of the kind " +
                             recording->name +
                             ", which is complete; expected a folder of scans, or depth/ and "
                             "camera.json, to follow");
  return fs::is_directory(folder / "depth") ? folder / "depth" : folder;
}

/// One that is malformed fails the image, by name, where load_scene finds none.
std::optional<Camera> find_camera_of(const fs::path& image) {
  try {
    return layouts::camera_beside(image);
  } catch (const std::runtime_error& error) {
    spdlog::warn("{}", error.what());
    return std::nullopt;
  }
}

}  // namespace

FollowedScans::FollowedScans(const fs::path& folder, bool real_time,
                             const std::atomic<bool>& interrupted)
    : folder_(folder_of_scans(folder)), real_time_(real_time), interrupted_(interrupted) {}

/// False when no more will come.
bool FollowedScans::wait() {
  while (!interrupted_) {
    const bool last = !folder_.ended().empty();
    for (Arrival& arrival : folder_.take(waiting_.empty() ? kPatience : kPatience * 0))
      waiting_.push_back(std::move(arrival));
    if (!waiting_.empty()) return true;
    if (last) return false;
  }
  return false;
}

std::optional<TakenScan> FollowedScans::next() {
  if (!wait()) return std::nullopt;
  if (real_time_) {
    left_out_ += waiting_.size() - 1;
    waiting_.erase(waiting_.begin(), waiting_.end() - 1);
  }
  most_behind_ = std::max(most_behind_, waiting_.size() - 1);
  const Arrival arrival = std::move(waiting_.front());
  waiting_.pop_front();
  return TakenScan{entry_of(arrival.file), arrival.when};
}

SceneEntry FollowedScans::entry_of(const fs::path& file) {
  SceneEntry entry;
  entry.number = taken_++;
  entry.name = file.stem().string();
  if (!names_.insert(entry.name).second) {
    char number[32];
    std::snprintf(number, sizeof number, "%06zu_", entry.number);
    names_.insert(entry.name = number + entry.name);
  }
  entry.file.path = file;
  entry.file.im_id = static_cast<int>(entry.number);
  if (formats::has_ending(file, formats::Wanted::kDepthImages))
    entry.file.camera = find_camera_of(file);
  return entry;
}

}  // namespace posevote::stream
