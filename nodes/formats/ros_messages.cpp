// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/ros_messages.hpp"

#include <array>
#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"

namespace posevote::formats {
namespace {

class Fields {
 public:
  explicit Fields(std::string_view message) : rest_(message) {}

  template <class T>
  T number() {
    return load_bytes<T>(take(sizeof(T)).data());
  }
  template <std::size_t N>
  std::array<double, N> numbers() {
    std::array<double, N> all;
    for (double& one : all) one = number<double>();
    return all;
  }
  /// Its length stands before it.
  std::string_view bytes(std::size_t of_each = 1) {
    return take(number<std::uint32_t>() * of_each);
  }
  /// Sequence number, time, frame.
  void skip_head() {
    take(3 * sizeof(std::uint32_t));
    bytes();
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw std::runtime_error("the message is cut off");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
};

}  // namespace

RosImage read_ros_image(std::string_view message) {
  Fields fields(message);
  fields.skip_head();
  RosImage image;
  image.height = fields.number<std::uint32_t>();
  image.width = fields.number<std::uint32_t>();
  image.encoding = fields.bytes();
  image.order = fields.number<std::uint8_t>() != 0 ? std::endian::big : std::endian::little;
  image.step = fields.number<std::uint32_t>();
  image.data = fields.bytes();
  return image;
}

RosCamera read_ros_camera(std::string_view message) {
  Fields fields(message);
  fields.skip_head();
  RosCamera camera;
  camera.height = fields.number<std::uint32_t>();
  camera.width = fields.number<std::uint32_t>();
  fields.bytes();                // the distortion's model
  fields.bytes(sizeof(double));  // its coefficients
  const auto K = fields.numbers<9>();
  fields.numbers<9>();  // R
  const auto P = fields.numbers<12>();
  if (P[0] != 0)
    camera.camera = Camera{P[0], P[5], P[2], P[6], 1};
  else if (K[0] != 0)
    camera.camera = Camera{K[0], K[4], K[2], K[5], 1};
  return camera;
}

}  // namespace posevote::formats
