// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS 1 as they were serialized: field after field, little-endian. Only what a depth
// image and its camera need; ROS' own headers of them are no C++20.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "nodes/data/files.hpp"

namespace posevote::formats {

/// sensor_msgs/Image. The views are into the message's bytes.
struct RosImage {
  std::size_t width = 0, height = 0;
  std::string_view encoding;
  std::endian order = std::endian::little;
  std::size_t step = 0;  ///< from one row to the next [bytes]
  std::string_view data;

  /// 16UC1 in mm or 32FC1 in m (REP 118).
  bool is_depth() const { return encoding == "16UC1" || encoding == "32FC1"; }
};

/// sensor_msgs/CameraInfo.
struct RosCamera {
  std::size_t width = 0, height = 0;  ///< of the images [pixel]; 0: not said
  std::optional<Camera>
      camera;  ///< P, which is of rectified images, else K; nothing: not calibrated
};

/// Each throws std::runtime_error for a message that is cut off.
RosImage read_ros_image(std::string_view message);
RosCamera read_ros_camera(std::string_view message);

}  // namespace posevote::formats
