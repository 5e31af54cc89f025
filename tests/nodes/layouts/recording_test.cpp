// SPDX-License-Identifier: BSD-3-Clause
// Folders of depth images as recorders write them, and the camera beside them.
#include "nodes/layouts/recording.hpp"

#include <catch2/catch.hpp>

#include "nodes/layouts/camera_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::recording_test {

using namespace posevote::layouts;
using Catch::Contains;
using posevote::test::TemporaryFolder;

namespace {

std::vector<SceneFile> frames_of(const TemporaryFolder& folder, const std::string& kind) {
  const Recording* recording = find_recording(folder.path());
  REQUIRE(recording);
  CHECK(recording->name == kind);
  return recording->frames(folder.path());
}

void check_camera(const std::optional<Camera>& camera, double depth_scale) {
  REQUIRE(camera);
  CHECK(camera->fx == 500);
  CHECK(camera->fy == 510);
  CHECK(camera->cx == 320);
  CHECK(camera->cy == 240);
  CHECK(camera->depth_scale == depth_scale);
}

}  // namespace

TEST_CASE("a TUM recording comes in the order of its timestamps", "[layouts]") {
  const TemporaryFolder folder;
  folder.write("depth.txt", "# depth maps\n20.5 depth/b.png\n3.25 depth/a.png\n");
  std::vector<SceneFile> frames = frames_of(folder, "TUM RGB-D");
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].path == folder / "depth/a.png");
  CHECK(frames[1].path == folder / "depth/b.png");
  CHECK(frames[0].camera->fx == 525);
  CHECK(frames[0].camera->depth_scale == 0.2);

  folder.write("camera.json", R"({"fx": 500, "fy": 510, "cx": 320, "cy": 240})");
  check_camera(frames_of(folder, "TUM RGB-D")[1].camera, 0.2);

  folder.write("depth.txt", "20.5 depth/b.png\nnoon depth/a.png\n");
  CHECK_THROWS_WITH(frames_of(folder, "TUM RGB-D"), Contains("depth.txt") && Contains("line 2"));
}

TEST_CASE("one scene of a BOP set is a recording, too", "[layouts]") {
  const TemporaryFolder folder;
  folder.write("scene_camera.json",
               R"({"10": {"cam_K": [500, 0, 320, 0, 510, 240, 0, 0, 1], "depth_scale": 0.1},
                   "9": {"cam_K": [400, 0, 320, 0, 410, 240, 0, 0, 1]}})");
  folder.write("depth/000010.png", "");
  folder.write("depth/000009.png", "");
  const std::vector<SceneFile> frames = frames_of(folder, "BOP scene");
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].camera->fx == 400);
  check_camera(frames[1].camera, 0.1);
  folder.write("depth/000011.png", "");
  CHECK_THROWS_WITH(frames_of(folder, "BOP scene"), Contains("image 11: has no camera"));
}

TEST_CASE("depth images find the camera beside them", "[layouts]") {
  const TemporaryFolder folder;
  folder.write("depth/2.png", "");
  folder.write("depth/1.npy", "");
  CHECK_FALSE(find_recording(folder.path()));
  CHECK_FALSE(camera_beside(folder / "depth/2.png"));
  folder.write("intrinsics.txt", "# left\n500 0 320\n0 510 240\n0 0 1\n");
  const std::vector<SceneFile> frames = frames_of(folder, "depth images");
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].path == folder / "depth/1.npy");
  check_camera(frames[1].camera, 0);
}

TEST_CASE("a camera is read in each way of writing it", "[layouts]") {
  const TemporaryFolder folder;
  const auto camera = [&](const std::string& name, const std::string& text) {
    const auto file = folder.write(name, text);
    const std::optional<Camera> read = find_camera(folder.path());
    std::filesystem::remove(file);
    return read;
  };
  check_camera(
      camera("camera.json", R"({"cx": 320, "cy": 240, "fx": 500, "fy": 510, "depth_scale": 0.1})"),
      0.1);
  check_camera(camera("camera_intrinsic.json",
                      R"({"width": 640, "intrinsic_matrix": [500, 0, 0, 0, 510, 0, 320, 240, 1]})"),
               0);
  check_camera(camera("intrinsics.json",
                      R"({"cam_K": [500, 0, 320, 0, 510, 240, 0, 0, 1], "depth_scale": 2})"),
               2);
  check_camera(camera("camera-intrinsics.txt", "500 510 320 240\n"), 0);

  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {R"({"fx": 500})", "key 'fy' not found"},
           {R"({"fx": -1, "fy": 1, "cx": 1, "cy": 1})", "fx and fy must be > 0"},
           {R"({"fx": 1, "fy": 1, "cx": 1, "cy": 1, "depth_scale": 0})", "depth_scale must be > 0"},
           {R"({"cam_K": [1, 2]})", "cam_K has 2 numbers, expected 9"},
           {"[]", "is no JSON object"}})
    CHECK_THROWS_WITH(camera("camera.json", text), Contains("camera.json") && Contains(what));
  std::filesystem::remove(folder / "camera.json");
  CHECK_THROWS_WITH(camera("intrinsics.txt", "1 2 3"),
                    Contains("intrinsics.txt") && Contains("has 3 numbers, expected fx fy cx cy"));
}

}  // namespace posevote::recording_test
