// SPDX-License-Identifier: BSD-3-Clause
// ROS 1 bags: depth images (nodes/formats/read_bag_image.cpp) and their cameras, sensor_msgs/CameraInfo
// of the topic camera_info beside the images' or the only one there is; else camera.json beside the
// bag. Of several topics of depth images one is chosen as BAG/TOPIC, and one image as
// BAG/TOPIC/NUMBER.
#include <algorithm>
#include <cstdio>

#include "nodes/formats/bag.hpp"
#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/ros_messages.hpp"
#include "nodes/layouts/camera_file.hpp"
#include "nodes/layouts/files.hpp"
#include "nodes/layouts/recording.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;
using formats::Bag;
using formats::BagMessage;
using formats::BagTopic;

bool holds_images(const BagTopic& topic) {
  return topic.type == "sensor_msgs/Image" && !topic.messages.empty();
}

bool holds_depth(const Bag& bag, const BagTopic& topic) {
  return holds_images(topic) &&
         formats::read_ros_image(bag.read(topic.messages.front())).is_depth();
}

std::vector<std::string> depth_topics(const Bag& bag) {
  std::vector<std::string> topics;
  for (const auto& [name, topic] : bag.topics())
    if (holds_depth(bag, topic)) topics.push_back(name);
  return topics;
}

/// "/rgb/image (sensor_msgs/Image 'rgb8'), ..."
std::string list_topics(const Bag& bag) {
  std::string text;
  for (const auto& [name, topic] : bag.topics()) {
    text += (text.empty() ? "" : ", ") + name + " (" + topic.type;
    if (holds_images(topic)) {
      const std::string message = bag.read(topic.messages.front());
      text += " " + formats::in_quotes(formats::read_ros_image(message).encoding);
    }
    text += ")";
  }
  return text.empty() ? "nothing" : text;
}

/// `wanted`: what stands behind the bag's name: nothing, a topic, or an image of it.
std::string choose_topic(const Bag& bag, const fs::path& file, const std::string& wanted) {
  const std::vector<std::string> topics = depth_topics(bag);
  if (topics.empty())
    throw std::runtime_error(
        "no depth image in it, expected sensor_msgs/Image of 16UC1 or 32FC1; it holds " +
        list_topics(bag));
  if (wanted.empty() && topics.size() == 1) return topics[0];
  std::string choices;
  for (const std::string& topic : topics) {
    if (wanted == topic || wanted.substr(0, wanted.rfind('/')) == topic) return topic;
    choices += (choices.empty() ? "" : " or ") + file.string() + topic;
  }
  throw std::runtime_error(wanted.empty()
                               ? "depth images on several topics; choose " + choices
                               : "no depth images on " + wanted + "; expected " + choices);
}

/// The topic of the images' camera; null where there is none.
const BagTopic* find_cameras(const Bag& bag, const std::string& images) {
  const std::string beside = images.substr(0, images.rfind('/') + 1) + "camera_info";
  std::vector<const BagTopic*> all;
  for (const auto& [name, topic] : bag.topics()) {
    if (topic.type != "sensor_msgs/CameraInfo" || topic.messages.empty()) continue;
    if (name == beside) return &topic;
    all.push_back(&topic);
  }
  if (all.size() > 1)
    throw std::runtime_error("which camera is that of " + images + "? Expected " + beside +
                             "; it holds " + list_topics(bag));
  return all.empty() ? nullptr : all[0];
}

/// K holds for images of that size alone.
void check_size(const formats::RosCamera& camera, const Bag& bag, const BagMessage& first) {
  const std::string message = bag.read(first);
  const formats::RosImage image = formats::read_ros_image(message);
  const auto differs = [](std::size_t said, std::size_t is) { return said != 0 && said != is; };
  if (differs(camera.width, image.width) || differs(camera.height, image.height))
    throw std::runtime_error("its camera is of images of " + std::to_string(camera.width) + " x " +
                             std::to_string(camera.height) + " pixels, but they have " +
                             std::to_string(image.width) + " x " + std::to_string(image.height));
}

/// For each image the camera that was told last before it, else the first.
class Cameras {
 public:
  Cameras(const Bag& bag, const std::string& images, const fs::path& file)
      : otherwise_(camera_beside(file)) {
    const BagTopic* topic = find_cameras(bag, images);
    if (!topic) return;
    for (const BagMessage& message : topic->messages) {
      const formats::RosCamera camera = formats::read_ros_camera(bag.read(message));
      if (cameras_.empty()) check_size(camera, bag, bag.topics().at(images).messages.front());
      cameras_[message.time] = camera.camera;
    }
  }

  std::optional<Camera> at(std::uint64_t time) const {
    if (cameras_.empty()) return otherwise_;
    auto camera = cameras_.upper_bound(time);
    if (camera != cameras_.begin()) --camera;
    return camera->second ? camera->second : otherwise_;
  }

 private:
  std::map<std::uint64_t, std::optional<Camera>> cameras_;  ///< by when each was recorded [ns]
  std::optional<Camera> otherwise_;
};

std::vector<SceneFile> read_bag(const fs::path& path, const fs::path& file) {
  const std::string wanted = path.string().substr(file.string().size());
  const auto bag = formats::open_bag(file);
  const std::string topic = choose_topic(*bag, file, wanted);
  const Cameras cameras(*bag, topic, file);
  std::vector<SceneFile> frames;
  for (const BagMessage& message : bag->topics().at(topic).messages) {
    char name[32];
    std::snprintf(name, sizeof name, "/%06zu", frames.size());
    frames.push_back({file.string() + topic + name, 0, 0, cameras.at(message.time)});
  }
  if (!wanted.empty() && wanted != topic)
    std::erase_if(frames, [&](const SceneFile& frame) { return frame.path != path; });
  if (frames.empty()) throw std::runtime_error("no image " + wanted);
  return frames;
}

const auto registered =
    register_recording({"ROS 1 bag", "a file .bag with depth images and their camera_info",
                        [](const fs::path& path) { return !formats::container_of(path).empty(); },
                        [](const fs::path& path) {
                          const fs::path file = formats::container_of(path);
                          try {
                            return read_bag(path, file);
                          } catch (const std::runtime_error& error) {
                            fail(file, error.what());
                          }
                        }});

}  // namespace
}  // namespace posevote::layouts
