// SPDX-License-Identifier: BSD-3-Clause
// ROS 1 bags (format 2.0): messages by topic, in chunks that may be compressed (bz2, lz4). ROS' own
// rosbag_storage trusts every offset in a file, and dies of one that is wrong; here all are checked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace posevote::formats {

/// Where a message lies.
struct BagMessage {
  std::uint64_t time = 0;    ///< at which it was recorded [ns]
  std::uint64_t chunk = 0;   ///< by the position of its record in the file [bytes]
  std::uint32_t offset = 0;  ///< in the chunk, once it is decompressed [bytes]
};

struct BagTopic {
  std::string type;                  ///< as sensor_msgs/Image
  std::vector<BagMessage> messages;  ///< in the order of time
};

/// What a bag holds, but for the messages themselves. Threads may share it.
class Bag {
 public:
  /// Reads the heads of all records. Throws std::runtime_error that says what is wrong, but does not
  /// repeat the path: where it is cut off, was never closed by its recorder, or contradicts itself.
  explicit Bag(std::filesystem::path file);

  /// By name, which begins with a slash.
  const std::map<std::string, BagTopic>& topics() const { return topics_; }
  /// As it was serialized. Throws as the constructor does.
  std::string read(const BagMessage& message) const;

 private:
  std::filesystem::path file_;
  std::map<std::string, BagTopic> topics_;
};

/// The bag that was opened last is kept for the next of its messages.
std::shared_ptr<const Bag> open_bag(const std::filesystem::path& file);

}  // namespace posevote::formats
