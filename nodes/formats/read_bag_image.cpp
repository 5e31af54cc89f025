// SPDX-License-Identifier: BSD-3-Clause
// Reads depth images of ROS 1 bags: sensor_msgs/Image of 16UC1 in mm or 32FC1 in m. The path of one
// is BAG/TOPIC/NUMBER, counted from 0 in the order of time.
#include <charconv>
#include <stdexcept>

#include "nodes/formats/bag.hpp"
#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/ros_messages.hpp"

namespace posevote::formats {
namespace {

constexpr std::size_t kMostPixelsAside = 8192;

/// The message's bytes.
std::string read_entry(const std::filesystem::path& path) {
  const std::filesystem::path file = container_of(path);
  const auto bag = open_bag(file);
  const std::string entry = path.string().substr(file.string().size());
  const std::size_t slash = entry.rfind('/');
  const std::string digits = slash == std::string::npos ? "" : entry.substr(slash + 1);
  std::size_t number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || read.ec != std::errc() || read.ptr != digits.data() + digits.size())
    throw std::runtime_error("is a whole bag or topic, expected BAG/TOPIC/NUMBER, one image in it");
  const auto topic = bag->topics().find(entry.substr(0, slash));
  if (topic == bag->topics().end() || number >= topic->second.messages.size())
    throw std::runtime_error("no such message in the bag");
  if (topic->second.type != "sensor_msgs/Image")
    throw std::runtime_error("is a " + in_quotes(topic->second.type) +
                             ", expected sensor_msgs/Image");
  return bag->read(topic->second.messages[number]);
}

template <class T>
std::vector<T> pixels_of(const RosImage& image) {
  if (image.step < image.width * sizeof(T) || image.data.size() < image.step * image.height)
    throw std::runtime_error("an image of " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels with " +
                             std::to_string(image.data.size()) + " bytes in rows of " +
                             std::to_string(image.step));
  std::vector<T> pixels;
  pixels.reserve(image.width * image.height);
  for (std::size_t v = 0; v < image.height; ++v)
    for (std::size_t u = 0; u < image.width; ++u)
      pixels.push_back(
          load_bytes<T>(image.data.data() + v * image.step + u * sizeof(T), image.order));
  return pixels;
}

DepthImage read_message(std::string_view bytes) {
  const RosImage image = read_ros_image(bytes);
  if (!image.is_depth())
    throw std::runtime_error("is an image of " + in_quotes(image.encoding) +
                             ", expected 16UC1 or 32FC1");
  if (image.width == 0 || image.height == 0 || image.width > kMostPixelsAside ||
      image.height > kMostPixelsAside)
    throw std::runtime_error("claims " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels");
  DepthImage depth{image.width, image.height};
  if (image.encoding == "32FC1")
    depth.metres = pixels_of<float>(image);
  else
    depth.values = pixels_of<std::uint16_t>(image);
  return depth;
}

const auto registered = register_format("ROS 1 bag", {".bag"}, read_message, read_entry);

}  // namespace
}  // namespace posevote::formats
