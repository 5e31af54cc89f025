// SPDX-License-Identifier: BSD-3-Clause
// ROS 1 bags as recordings: their depth images in the order of time, and the cameras of these.
#include <catch2/catch.hpp>

#include "nodes/formats/depth_image.hpp"
#include "nodes/formats/scan_hash.hpp"
#include "nodes/layouts/recording.hpp"
#include "tests/support/bag_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::rosbag_test {

using namespace posevote::test;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;
using Depths = std::vector<std::uint16_t>;

const std::string kImage = "sensor_msgs/Image", kInfo = "sensor_msgs/CameraInfo";
const std::array<double, 4> kCamera{500, 510, 1.5, 1};

std::string depth(std::uint16_t first) {
  return ros_image<std::uint16_t>(3, 2, "16UC1", {first, 2, 3, 4, 5, 6});
}

std::vector<SceneFile> frames_of(const fs::path& path) {
  const layouts::Recording* recording = layouts::find_recording(path);
  REQUIRE(recording);
  CHECK(recording->name == "ROS 1 bag");
  return recording->frames(path);
}

/// What the bag's frames cannot be listed for.
std::string refusal(const TemporaryFolder& folder, const std::string& bytes,
                    const std::string& behind = "") {
  static int count = 0;
  const std::string file = folder.write(std::to_string(count++) + ".bag", bytes);
  const std::string error = error_of([&] { frames_of(file + behind); });
  CHECK_THAT(error, Catch::StartsWith(file + ": "));
  return error;
}

/// A camera, and images of two chunks, the later one first.
BagWriter two_images(const std::string& compression) {
  BagWriter bag(compression);
  bag.add("/depth/camera_info", kInfo, 1, ros_camera(3, 2, kCamera));
  bag.add("/depth/image", kImage, 3, depth(30)).end_chunk();
  bag.add("/rgb/image", kImage, 2, ros_image<char>(1, 1, "mono8", {'x'}));
  bag.add("/depth/image", kImage, 2, depth(20));
  return bag;
}

}  // namespace

TEST_CASE("a bag gives its depth images in the order of time", "[layouts][bag]") {
  const TemporaryFolder folder;
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    INFO(compression);
    const fs::path file = folder.write(compression + ".bag", two_images(compression).bytes());
    const std::vector<SceneFile> frames = frames_of(file);
    REQUIRE(frames.size() == 2);
    CHECK(frames[1].path == file / "depth/image/000001");
    CHECK(frames[1].camera->fy == 510);
    CHECK(frames[1].camera->cx == 1.5);
    const formats::DepthImage first = formats::read_depth_image(frames[0].path);
    CHECK(first.width == 3);
    CHECK(first.height == 2);
    CHECK(first.values == Depths{20, 2, 3, 4, 5, 6});
    CHECK(formats::read_depth_image(frames[1].path).values[0] == 30);
    CHECK(formats::hash_scan(frames[0]) != formats::hash_scan(frames[1]));
    CHECK(frames_of(file / "depth/image").size() == 2);
    const std::vector<SceneFile> one = frames_of(frames[1].path);
    REQUIRE(one.size() == 1);
    CHECK(one[0].path == frames[1].path);
  }
}

TEST_CASE("a chunk of several megabytes is decompressed to its end", "[layouts][bag]") {
  const TemporaryFolder folder;
  Depths values(2000 * 1500);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<std::uint16_t>(i * i * 7919 / 3);
  for (const std::string compression : {"bz2", "lz4"}) {
    BagWriter bag(compression);
    bag.add("/image", kImage, 1, ros_image(2000, 1500, "16UC1", values));
    const fs::path file = folder.write(compression + ".bag", bag.bytes());
    CHECK(formats::read_depth_image(frames_of(file).at(0).path).values == values);
  }
}

TEST_CASE("metres and either order of bytes are read", "[layouts][bag]") {
  const TemporaryFolder folder;
  BagWriter bag;
  bag.add("/a", kImage, 1, ros_image<float>(2, 1, "32FC1", {0.5F, 1.25F}));
  bag.add("/b", kImage, 1, ros_image<std::uint16_t>(2, 1, "16UC1", {500, 1250}, std::endian::big));
  const fs::path file = folder.write("a.bag", bag.bytes());
  CHECK(formats::read_depth_image(file / "a/000000").metres == std::vector<float>{0.5F, 1.25F});
  CHECK(formats::read_depth_image(file / "b/000000").values == Depths{500, 1250});
  CHECK_THAT(error_of([&] { formats::read_depth_image(file / "b/000001"); }),
             has("no such message"));
  CHECK_THAT(error_of([&] { formats::read_depth_image(file); }), has("BAG/TOPIC/NUMBER"));
}

TEST_CASE("of several topics with depth images one is chosen", "[layouts][bag]") {
  const TemporaryFolder folder;
  BagWriter bag;
  bag.add("/left", kImage, 1, depth(1)).add("/right", kImage, 1, depth(2));
  const std::string file = folder.write("a.bag", bag.bytes());
  CHECK_THAT(error_of([&] { frames_of(file); }),
             has("several topics; choose " + file + "/left or " + file + "/right"));
  CHECK(frames_of(file + "/right").at(0).path == file + "/right/000000");
  CHECK_THAT(error_of([&] { frames_of(file + "/up"); }), has("no depth images on /up"));
  CHECK_THAT(error_of([&] { frames_of(file + "/left/7"); }), has("no image /left/7"));
}

TEST_CASE("a bag without depth images says what it holds", "[layouts][bag]") {
  const TemporaryFolder folder;
  BagWriter bag;
  bag.add("/ir", kImage, 1, ros_image<std::uint16_t>(1, 1, "mono16", {7}));
  bag.add("/packed", "sensor_msgs/CompressedImage", 1, "png");
  CHECK_THAT(refusal(folder, bag.bytes()),
             has("no depth image") &&
                 has("/ir (sensor_msgs/Image 'mono16'), /packed (sensor_msgs/CompressedImage)"));
}

TEST_CASE("an image's camera is the one that was told last before it", "[layouts][bag]") {
  const TemporaryFolder folder;
  const auto camera = [](double fx) { return ros_camera(3, 2, {fx, fx, 1, 1}); };
  BagWriter bag;
  for (std::uint32_t time : {1, 3, 6}) bag.add("/d/image", kImage, time, depth(1));
  CHECK_FALSE(frames_of(folder.write("none.bag", bag.bytes()))[0].camera);

  BagWriter uncalibrated = bag;
  uncalibrated.add("/d/camera_info", kInfo, 1, camera(0));
  folder.write("beside/camera.json", R"({"fx": 9, "fy": 9, "cx": 1, "cy": 1})");
  for (const BagWriter& one : {bag, uncalibrated})
    CHECK(frames_of(folder.write("beside/a.bag", BagWriter(one).bytes()))[2].camera->fx == 9);

  BagWriter known = bag;
  known.add("/other/camera_info", kInfo, 1, camera(7));
  CHECK(frames_of(folder.write("other.bag", BagWriter(known).bytes()))[0].camera->fx == 7);
  BagWriter unclear = known;
  unclear.add("/third/camera_info", kInfo, 1, camera(8));
  CHECK_THAT(refusal(folder, unclear.bytes()), has("which camera") && has("/d/camera_info"));
  known.add("/d/camera_info", kInfo, 2, camera(500)).add("/d/camera_info", kInfo, 5, camera(600));
  const std::vector<SceneFile> frames = frames_of(folder.write("two.bag", known.bytes()));
  CHECK(frames[0].camera->fx == 500);
  CHECK(frames[1].camera->fx == 500);
  CHECK(frames[2].camera->fx == 600);

  bag.add("/d/camera_info", kInfo, 1, ros_camera(640, 480, kCamera));
  CHECK_THAT(refusal(folder, bag.bytes()), has("640 x 480 pixels, but they have 3 x 2"));
}

TEST_CASE("a bag that is damaged or not closed is refused in words", "[layouts][bag]") {
  const TemporaryFolder folder;
  const std::string whole = two_images("none").bytes();
  CHECK_THAT(refusal(folder, "#ROSBAG V1.2\n"), has("not a ROS bag of format 2.0"));
  CHECK_THAT(refusal(folder, whole.substr(0, whole.size() / 2)), has("is cut off"));

  const auto with = [&](const std::string& key, const std::string& value) {
    std::string bytes = whole;
    return bytes.replace(bytes.find(key + "=") + key.size() + 1, value.size(), value);
  };
  CHECK_THAT(refusal(folder, with("index_pos", std::string(8, '\0'))), has("rosbag reindex"));
  CHECK_THAT(refusal(folder, with("chunk_count", "\x07")), has("has not the chunks"));
  for (const std::string topic : {"/d/../e", "/d//e", "/d/", "/d\x1b[2J"})
    CHECK_THAT(refusal(folder, BagWriter().add(topic, kImage, 1, depth(1)).bytes()),
               has("a topic of the name '/d"));
  CHECK_THAT(refusal(folder, with("size", "\x10")), has("beyond their chunk"));
  CHECK_THAT(refusal(folder, two_images("zstd").bytes()),
             has("compressed by 'zstd', expected none, bz2 or lz4"));
  for (const std::string compression : {"bz2", "lz4"}) {
    std::string bytes = two_images(compression).bytes();
    const std::size_t size = bytes.find("size=") + 5;
    CHECK_THAT(refusal(folder, std::string(bytes).replace(size, 4, "\xff\xff\xff\xff")),
               has("a chunk claims 4294967295 bytes"));
    CHECK_THAT(refusal(folder, std::string(bytes).replace(size + 1, 1, "\x7f")),
               has("holds less than the"));
    bytes[bytes.find(compression == "bz2" ? "BZh" : "\x04\x22\x4d\x18") + 6] ^= 0x15;
    CHECK_THAT(refusal(folder, bytes), has("cannot be decompressed"));
  }
}

TEST_CASE("an image of a bag that contradicts itself fails alone", "[layouts][bag]") {
  const TemporaryFolder folder;
  std::string wide = depth(1);
  wide.replace(wide.find("camera") + 10, 4, "\xff\xff\xff\x7f");
  BagWriter bag;
  bag.add("/d", kImage, 1, depth(1)).add("/d", kImage, 2, wide).add("/d", kImage, 3, "short");
  bag.add("/d", kImage, 4, ros_image<std::uint16_t>(3, 9, "16UC1", {1, 2}));
  bag.add("/d", kImage, 5, ros_image<char>(1, 1, "mono8", {1}));
  const std::vector<SceneFile> frames = frames_of(folder.write("a.bag", bag.bytes()));
  REQUIRE(frames.size() == 5);
  const auto error = [&](int i) {
    return error_of([&] { formats::read_depth_image(frames[static_cast<std::size_t>(i)].path); });
  };
  CHECK(error(0) == "(no error)");
  CHECK_THAT(error(1), has("claims 2147483647 x 2 pixels"));
  CHECK_THAT(error(2), has("the message is cut off"));
  CHECK_THAT(error(3), has("3 x 9 pixels with 4 bytes"));
  CHECK_THAT(error(4), has("an image of 'mono8', expected 16UC1 or 32FC1"));
}

}  // namespace posevote::rosbag_test
