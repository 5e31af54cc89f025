// SPDX-License-Identifier: BSD-3-Clause
// The same frames in each kind of recording: a TUM folder, a folder of PNG, ROS 1 bags.
#include <catch2/catch.hpp>

#include "nodes/formats/depth_image.hpp"
#include "tests/support/bag_writer.hpp"
#include "tests/support/small_images.hpp"

namespace posevote::recordings_test {

using namespace posevote::test;

namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 3;

fs::path image(const fs::path& folder, int i) {
  return folder / ("00000" + std::to_string(i) + ".png");
}

/// formats::DepthImage in whole millimetres, as cameras write them.
std::vector<std::uint16_t> in_millimetres(const formats::DepthImage& depth, double scale) {
  std::vector<std::uint16_t> whole;
  for (const std::uint16_t raw : depth.values)
    whole.push_back(static_cast<std::uint16_t>(std::lround(raw * scale)));
  return whole;
}

class Recorder {
 public:
  explicit Recorder(const SmallImages& images) : folder_(images.folder) {
    const auto camera = read_json(images.scene / "scene_camera.json")["0"];
    const auto& k = camera["cam_K"];
    camera_ = {k[0], k[4], k[2], k[5]};
    for (int i = 0; i < kFrames; ++i) {
      const formats::DepthImage raw = formats::read_depth_image(image(images.scene / "depth", i));
      images_.push_back({raw.width, raw.height, in_millimetres(raw, camera["depth_scale"])});
    }
  }

  std::string png() const { return write_images("png", ""); }
  std::string tum() const {
    std::string list = "# timestamp file\n";
    for (int i = kFrames; i-- > 0;)  // the timestamps say the order
      list += std::to_string(i) + ".5 " + image("depth", i).string() + "\n";
    return write_images("tum", list);
  }
  std::string bag(const std::string& compression, bool in_metres) const {
    BagWriter bag(compression);
    const auto width = static_cast<std::uint32_t>(images_[0].width);
    const auto height = static_cast<std::uint32_t>(images_[0].height);
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      bag.add("/depth/camera_info", "sensor_msgs/CameraInfo", i,
              ros_camera(width, height, camera_));
      bag.add("/depth/image_raw", "sensor_msgs/Image", i,
              in_metres ? ros_image(width, height, "32FC1", formats::depths_of(images_[i], 1))
                        : ros_image(width, height, "16UC1", images_[i].values));
      bag.end_chunk();
    }
    return folder_.write(compression + ".bag", bag.bytes());
  }

 private:
  std::string write_images(const std::string& name, const std::string& list) const {
    for (int i = 0; i < kFrames; ++i) {
      const formats::DepthImage& one = images_[static_cast<std::size_t>(i)];
      folder_.write(image(name + "/depth", i).string(),
                    depth_png(static_cast<std::uint32_t>(one.width),
                              static_cast<std::uint32_t>(one.height), one.values));
    }
    if (!list.empty()) folder_.write(name + "/depth.txt", list);
    folder_.write(name + "/camera.json", nlohmann::json{{"fx", camera_[0]},
                                                        {"fy", camera_[1]},
                                                        {"cx", camera_[2]},
                                                        {"cy", camera_[3]},
                                                        {"depth_scale", 1}}
                                             .dump());
    return (folder_ / name).string();
  }

  const TemporaryFolder& folder_;
  std::array<double, 4> camera_{};           ///< fx, fy, cx, cy [pixel]
  std::vector<formats::DepthImage> images_;  ///< in mm
};

CommandResult run(const TemporaryFolder& folder, const std::string& scenes,
                  const std::string& how) {
  return run_posevote(folder, "run --models " + (folder / "data/models").string() + " --scenes " +
                                  scenes + " --out " + (folder / "out").string() + " " + how);
}

}  // namespace

TEST_CASE("the same frames have the same poses in each kind of recording", "[recordings]") {
  const SmallImages images;
  const TemporaryFolder& folder = images.folder;
  const Recorder recorder(images);
  std::string first;
  for (const std::string& recording : {recorder.png(), recorder.tum(), recorder.bag("none", false),
                                       recorder.bag("bz2", true), recorder.bag("lz4", false)}) {
    const CommandResult done = run(folder, recording, "--overwrite");
    INFO(recording << "\n" << done.output);
    CHECK(done.status == 0);
    if (first.empty()) first = answers(folder / "out");
    CHECK(std::count(first.begin(), first.end(), '\n') > kFrames);
    CHECK(answers(folder / "out") == first);
  }
}

TEST_CASE("a run of a bag is resumed, and notices another image in it", "[recordings]") {
  const SmallImages images;
  const TemporaryFolder& folder = images.folder;
  const Recorder recorder(images);
  const std::string bag = recorder.bag("lz4", false);
  CHECK(run(folder, bag, "--shard 1/2").status == 0);
  CHECK(run(folder, bag, "--shard 1/2 --resume").status == 0);
  const std::string packed_otherwise = recorder.bag("none", false);
  fs::rename(packed_otherwise, bag);
  CHECK(run(folder, bag, "--shard 1/2 --resume").status == 0);
  fs::rename(recorder.bag("none", true), bag);
  const CommandResult other = run(folder, bag, "--shard 1/2 --resume");
  CHECK(other.status != 0);
  CHECK_THAT(other.output, Catch::Contains("lz4.bag/depth/image_raw/000000") &&
                               Catch::Contains("holds something else now"));
}

TEST_CASE("a damaged bag fails by name, and the scans beside it are answered", "[recordings]") {
  const SmallImages images;
  const TemporaryFolder& folder = images.folder;
  const Recorder recorder(images);
  const std::string whole = recorder.bag("none", false);
  fs::create_directory(folder / "bags");
  fs::rename(whole, folder / "bags/whole.bag");
  const std::string bytes = read_text(folder / "bags/whole.bag");
  folder.write("bags/cut.bag", bytes.substr(0, bytes.size() / 2));
  CHECK(run(folder, (folder / "bags").string(), "").status == 1);
  const auto failures = read_json(folder / "out/failures.json");
  REQUIRE(failures.size() == 1);
  CHECK_THAT(failures[0]["file"].get<std::string>(), Catch::EndsWith("cut.bag"));
  CHECK_THAT(failures[0]["what"].get<std::string>(), Catch::Contains("is cut off"));
  CHECK(read_json(folder / "out/results.json")["frames"].size() == kFrames);
}

}  // namespace posevote::recordings_test
