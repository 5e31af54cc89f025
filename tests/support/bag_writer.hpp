// SPDX-License-Identifier: BSD-3-Clause
// Small ROS 1 bags as a recorder writes them, http://wiki.ros.org/Bags/Format/2.0, and the messages
// of a depth camera.
#pragma once

#include <bzlib.h>
#include <lz4frame.h>

#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/nodes/formats/support.hpp"

namespace posevote::test {

/// Its length before it.
inline std::string sized(const std::string& bytes) {
  return values<std::uint32_t>({static_cast<std::uint32_t>(bytes.size())}) + bytes;
}

template <class T>
std::string field(const std::string& name, T value) {
  std::string bytes = name + "=";
  append(bytes, value);
  return sized(bytes);
}
inline std::string field(const std::string& name, const std::string& text) {
  return sized(name + "=" + text);
}

inline std::string compressed(std::string plain, const std::string& how) {
  if (how == "bz2") {
    unsigned size = static_cast<unsigned>(plain.size() + plain.size() / 100 + 600);
    std::string packed(size, '\0');
    BZ2_bzBuffToBuffCompress(packed.data(), &size, plain.data(),
                             static_cast<unsigned>(plain.size()), 9, 0, 0);
    return packed.substr(0, size);
  }
  if (how == "lz4") {
    std::string packed(LZ4F_compressFrameBound(plain.size(), nullptr), '\0');
    return packed.substr(
        0, LZ4F_compressFrame(packed.data(), packed.size(), plain.data(), plain.size(), nullptr));
  }
  return plain;
}

class BagWriter {
 public:
  /// `compression`: none, bz2 or lz4; any other is only claimed.
  explicit BagWriter(std::string compression = "none") : compression_(std::move(compression)) {}

  /// A message recorded after so many seconds.
  BagWriter& add(const std::string& topic, const std::string& type, std::uint32_t time,
                 const std::string& data) {
    const auto [known, is_new] =
        connections_.try_emplace(topic, static_cast<std::uint32_t>(connections_.size()), type);
    const std::uint32_t id = known->second.first;
    if (is_new) chunk_ += connection(topic);
    index_[id] += values<std::uint32_t>({time, 0, static_cast<std::uint32_t>(chunk_.size())});
    chunk_ += sized(field<std::uint8_t>("op", 2) + field("conn", id) + field("time", at(time))) +
              sized(data);
    return *this;
  }
  /// What is added from now on comes into another chunk.
  BagWriter& end_chunk() {
    chunks_ += sized(field<std::uint8_t>("op", 5) + field("compression", compression_) +
                     field("size", static_cast<std::uint32_t>(chunk_.size()))) +
               sized(compressed(chunk_, compression_));
    for (const auto& [id, entries] : index_)
      chunks_ +=
          sized(field<std::uint8_t>("op", 4) + field<std::uint32_t>("ver", 1) + field("conn", id) +
                field("count", static_cast<std::uint32_t>(entries.size() / 12))) +
          sized(entries);
    infos_ += sized(field<std::uint8_t>("op", 6)) + sized("");
    ++chunk_count_;
    chunk_.clear();
    index_.clear();
    return *this;
  }
  std::string bytes() {
    if (!chunk_.empty()) end_chunk();
    std::string index;
    for (const auto& [topic, known] : connections_) index += connection(topic);
    const std::string magic = "#ROSBAG V2.0\n";
    const auto head = [&](std::uint64_t index_pos) {
      return sized(field<std::uint8_t>("op", 3) + field("index_pos", index_pos) +
                   field("conn_count", static_cast<std::uint32_t>(connections_.size())) +
                   field("chunk_count", chunk_count_)) +
             sized("   ");
    };
    return magic + head(magic.size() + head(0).size() + chunks_.size()) + chunks_ + index + infos_;
  }

 private:
  static std::uint64_t at(std::uint32_t time) { return time; }  // nanoseconds are the upper half
  std::string connection(const std::string& topic) const {
    const auto& [id, type] = connections_.at(topic);
    return sized(field<std::uint8_t>("op", 7) + field("conn", id) + field("topic", topic)) +
           sized(field("topic", topic) + field("type", type));
  }

  std::string compression_, chunk_, chunks_, infos_;
  std::uint32_t chunk_count_ = 0;
  std::map<std::string, std::pair<std::uint32_t, std::string>> connections_;
  std::map<std::uint32_t, std::string> index_;
};

/// Sequence number, time, frame.
inline std::string ros_head() { return values<std::uint32_t>({0, 0, 0}) + sized("camera"); }

/// sensor_msgs/Image
template <class T>
std::string ros_image(std::uint32_t width, std::uint32_t height, const std::string& encoding,
                      const std::vector<T>& pixels, std::endian order = std::endian::little) {
  std::string message = ros_head() + values<std::uint32_t>({height, width}) + sized(encoding);
  append<std::uint8_t>(message, order == std::endian::big);
  append(message, static_cast<std::uint32_t>(width * sizeof(T)));
  return message + sized(values(pixels, order));
}

/// sensor_msgs/CameraInfo; fx, fy, cx, cy.
inline std::string ros_camera(std::uint32_t width, std::uint32_t height,
                              const std::array<double, 4>& k) {
  return ros_head() + values<std::uint32_t>({height, width}) + sized("plumb_bob") +
         values<std::uint32_t>({0}) + values<double>({k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1}) +
         values<double>({1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         values<double>({k[0], 0, k[2], 0, 0, k[1], k[3], 0, 0, 0, 1, 0});
}

}  // namespace posevote::test
