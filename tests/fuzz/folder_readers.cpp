// SPDX-License-Identifier: BSD-3-Clause
// Files that are read as part of a folder: the folder is made once, and the one file written anew.
#include <memory>
#include <stdexcept>

#include "nodes/formats/depth_image.hpp"
#include "nodes/formats/sensor_pose.hpp"
#include "nodes/formats/write_ply.hpp"
#include "nodes/layouts/camera_file.hpp"
#include "nodes/layouts/layout.hpp"
#include "nodes/layouts/models_info.hpp"
#include "nodes/layouts/recording.hpp"
#include "tests/fuzz/reader.hpp"
#include "tests/support/bag_writer.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::test {
namespace {

using Folder = std::shared_ptr<TemporaryFolder>;
namespace fs = std::filesystem;

/// Files and their texts; those that end in .ply get a model.
Folder make_folder(const std::vector<std::pair<std::string, std::string>>& files) {
  auto folder = std::make_shared<TemporaryFolder>();
  Mesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << 0, 0, 0, 0.03F, 0, 0, 0, 0.04F, 0, 0, 0, 0.12F;
  for (const auto& [name, text] : files) {
    folder->write(name, text);
    if (name.ends_with(".ply")) formats::write_ply(*folder / name, mesh);
  }
  return folder;
}

/// Writes the bytes as that file of the folder, and then uses the folder.
Reader reader_of(const std::string& name, const Folder& folder, const std::string& file,
                 const std::function<void(const fs::path& folder)>& use,
                 std::vector<Sample> samples) {
  return {name,
          [=](std::string_view bytes) {
            fs::remove(*folder / file);  // to write over it would wait for the disk
            folder->write(file, std::string(bytes));
            use(folder->path());
          },
          std::move(samples)};
}

void read_scenes(const fs::path& folder) {
  layouts::find_layout(folder, "test").scenes(folder, "test");
}

void read_truth(const fs::path& folder) {
  layouts::find_layout(folder, "test").truth(folder, "test");
}

void read_recording(const fs::path& folder) {
  const layouts::Recording* recording = layouts::find_recording(folder);
  if (!recording) throw std::runtime_error("no recording");
  recording->frames(folder);
}

/// Under a name of its own each time: a bag that was opened stays known for the next of its images.
void read_bag(std::string_view bytes) {
  static const TemporaryFolder folder;
  static std::size_t count = 0;
  const fs::path file = folder.write(std::to_string(count++) + ".bag", std::string(bytes));
  const std::shared_ptr<void> removal(nullptr, [&](void*) { fs::remove(file); });
  for (const SceneFile& frame : layouts::find_recording(file)->frames(file))
    formats::read_depth_image(frame.path);
}

std::string bag(const std::string& compression) {
  BagWriter bag(compression);
  bag.add("/d/camera_info", "sensor_msgs/CameraInfo", 1, ros_camera(3, 2, {500, 510, 1.5, 1}));
  bag.add("/d/image", "sensor_msgs/Image", 2,
          ros_image<std::uint16_t>(3, 2, "16UC1", {1, 2, 3, 4, 5, 6}));
  bag.end_chunk();
  bag.add("/d/image", "sensor_msgs/Image", 3, ros_image<float>(2, 1, "32FC1", {0.5F, 1.25F}));
  return bag.bytes();
}

const std::string kCamera = R"({"0": {"cam_K": [500, 0, 320, 0, 510, 240, 0, 0, 1],
      "depth_scale": 0.1}})";
const std::string kPoses = R"({"0": [{"cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1],
      "cam_t_m2c": [10, 20.5, 9e2], "obj_id": 1}]})";
const std::string kVisible = R"({"0": [{"visib_fract": 0.75, "px_count_all": 100}]})";
const std::string kModels = R"({"1": {"diameter": 130, "min_x": 0, "min_y": 0, "min_z": 0,
      "size_x": 30, "size_y": 40, "size_z": 120,
      "symmetries_discrete": [[-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]],
      "symmetries_continuous": [{"axis": [0, 0, 1], "offset": [0, 0, 5]}]}})";

Folder bop_folder() {
  return make_folder({{"models/obj_000001.ply", ""},
                      {"models/models_info.json", kModels},
                      {"test/000001/scene_camera.json", kCamera},
                      {"test/000001/scene_gt.json", kPoses},
                      {"test/000001/scene_gt_info.json", kVisible},
                      {"test/000001/depth/000000.png", ""}});
}

Folder sixd_folder() {
  return make_folder({{"models/obj_02.ply", ""},
                      {"models/models_info.yml",
                       "2: {diameter: 130, min_x: 0, min_y: 0, min_z: 0, size_x: 30, size_y: 40, "
                       "size_z: 120}\n"},
                      {"test/05/info.yml",
                       "7:\n  cam_K: [500.0, 0.0, 320.0, 0.0, 510.0, 240.0, 0.0, 0.0, 1.0]\n"
                       "  depth_scale: 0.1\n"},
                      {"test/05/depth/0007.png", ""}});
}

Folder uwa_folder() { return make_folder({{"models/chef.ply", ""}, {"scenes/rs1.ply", ""}}); }

}  // namespace

std::vector<Reader> folder_readers() {
  const auto models_info = [](const fs::path& folder) {
    layouts::known_symmetries(folder / "models/models_info.json");
  };
  const auto camera = [](const fs::path& folder) {
    if (!layouts::find_camera(folder)) throw std::runtime_error("no camera");
  };
  return {
      reader_of("scene_camera", bop_folder(), "test/000001/scene_camera.json", read_scenes,
                {{"one image", kCamera}}),
      reader_of("scene_gt", bop_folder(), "test/000001/scene_gt.json", read_truth,
                {{"one pose", kPoses}}),
      reader_of("scene_gt_info", bop_folder(), "test/000001/scene_gt_info.json", read_truth,
                {{"one pose", kVisible}}),
      reader_of("models_info", bop_folder(), "models/models_info.json", models_info,
                {{"with symmetries", kModels}}),
      reader_of("sixd_gt", sixd_folder(), "test/05/gt.yml", read_truth,
                {{"one pose",
                  "7:\n- cam_R_m2c: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n  cam_t_m2c: [10.0, 20, 9e2]\n"
                  "  obj_bb: [1, 2, 3, 4]\n  obj_id: 2\n",
                  false}}),
      reader_of("xf", uwa_folder(), "ground_truth/chef-rs1.xf", read_truth,
                {{"a shift", "1 0 0 10\n0 1 0 20\n0 0 1 900\n0 0 0 1\n"}}),
      reader_of("camera_json", make_folder({}), "camera.json", camera,
                {{"BOP's", R"({"fx": 500, "fy": 510, "cx": 320, "cy": 240, "depth_scale": 0.1})"},
                 {"Open3D's",
                  R"({"width": 640, "height": 480,
                      "intrinsic_matrix": [500, 0, 0, 0, 510, 0, 320, 240, 1]})"}}),
      reader_of("intrinsics_txt", make_folder({}), "intrinsics.txt", camera,
                {{"four numbers", "500 510 320 240\n", false},
                 {"a matrix", "500 0 320\n0 510 240\n0 0 1\n", false}}),
      reader_of("tum", make_folder({{"depth/a.png", ""}}), "depth.txt", read_recording,
                {{"two frames", "# depth maps\n20.5 depth/b.png\n3.25 depth/a.png\n", false}}),
      {"bag", read_bag, {{"plain", bag("none")}, {"bz2", bag("bz2")}, {"lz4", bag("lz4")}}},
      {"pose",
       [](std::string_view text) { formats::sensor_pose(formats::read_pose_numbers(text)); },
       {{"a place", "# where it stood\n0.1, 0.2; 0.3\n", false},
        {"a quaternion", "[0 0 1] 0 0 0 1\n", false},
        {"a matrix", "1 0 0 10\n0 1 0 20\n0 0 1 900\n0 0 0 1\n", false}}}};
}

}  // namespace posevote::test
