// SPDX-License-Identifier: BSD-3-Clause
// A scan's colours on their way to the nodes that use them.
#include "nodes/color/srgb.hpp"
#include "nodes/data/features.hpp"
#include "nodes/data/files.hpp"
#include "nodes/layouts/color_beside.hpp"
#include "nodes/layouts/recording.hpp"
#include "tests/nodes/formats/support.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::scene_colors_test {

using namespace posevote::test;

namespace {

const std::string kPixels("\x0a\x14\x1e\xff\x80\x00", 6);

SceneFile depth_scene(const TemporaryFolder& folder) {
  SceneFile scene;
  scene.path = folder.write("depth/000001.png", depth_png(2, 1, {0, 1000}));
  scene.camera = Camera{10, 10, 0.5, 0.5, 1};
  return scene;
}

}  // namespace

TEST_CASE("load_scene: pixels have the colours of the image beside", "[load][color]") {
  const TemporaryFolder folder;
  SceneFile scene = depth_scene(folder);
  CHECK(run_node<Scan>("load_scene", {}, scene).colors.rows() == 0);
  scene.color = folder.write("rgb/000001.png", png_bytes(2, 1, 8, 3, kPixels));
  const Scan scan = run_node<Scan>("load_scene", {}, scene);
  REQUIRE(scan.colors.rows() == 1);  // one pixel has a depth: the second
  CHECK(scan.colors(0, 0) == 1);
  CHECK(scan.colors(0, 1) == color::linear_of(std::uint8_t{128}));
  CHECK(run_node<Scan>("load_scene", {{"colors", "false"}}, scene).colors.rows() == 0);
}

TEST_CASE("load_scene: a colour image that does not fit is left out", "[load][color]") {
  const TemporaryFolder folder;
  SceneFile scene = depth_scene(folder);
  for (const std::string& bytes : {png_bytes(1, 1, 8, 3, "abc"), std::string("nothing")}) {
    scene.color = folder.write("rgb/000001.png", bytes);
    const Scan scan = run_node<Scan>("load_scene", {}, scene);
    CHECK(scan.points.rows() == 1);
    CHECK(scan.colors.rows() == 0);
  }
}

TEST_CASE("load_scene: colours of another moment are left out and named", "[load][color]") {
  constexpr int kWidth = 320, kHeight = 240;
  std::vector<std::uint16_t> depths(std::size_t{kWidth} * kHeight, 2000);
  std::string pixels(std::size_t{3} * kWidth * kHeight, '\x40');
  for (int y = 60; y < 180; ++y)
    for (int x = 40; x < 160; ++x) depths[static_cast<std::size_t>(y * kWidth + x)] = 1000;
  for (int y = 60; y < 180; ++y)  // the same box, but moved
    for (int x = 110; x < 230; ++x) pixels[static_cast<std::size_t>(3 * (y * kWidth + x))] = '\xff';
  const TemporaryFolder folder;
  SceneFile scene;
  scene.path = folder.write("depth/000001.png", depth_png(kWidth, kHeight, depths));
  scene.camera = Camera{300, 300, 160, 120, 1};
  scene.color = folder.write("rgb/000001.png", png_bytes(kWidth, kHeight, 8, 3, pixels));
  std::vector<std::string> warnings;
  graph::FrameContext context;
  context.on_warning = [&](const std::string& what) { warnings.push_back(what); };
  const graph::NodeSpec& spec = *graph::find_node("load_scene");
  const std::vector<graph::Value> inputs{graph::StreamTraits<SceneFile>::wrap(SceneFile(scene))};
  const Scan scan =
      graph::StreamTraits<Scan>::unwrap(spec.call(inputs, context, spec.make_params().get()).at(0));
  CHECK(scan.colors.rows() == 0);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("rgb/000001.png: does not show what the depth image"));
  CHECK(run_node<Scan>("load_scene", {{"check_colors", "false"}}, scene).colors.rows() > 0);
}

TEST_CASE("layouts: the colour image of a depth image", "[layouts][color]") {
  const TemporaryFolder folder;
  const auto depth = folder.write("depth/000001.png", "");
  CHECK(layouts::color_beside(depth).empty());
  folder.write("gray/000001.png", "");
  CHECK(layouts::color_beside(depth) == folder / "gray/000001.png");
  folder.write("rgb/000001.jpg", "");
  CHECK(layouts::color_beside(depth) == folder / "rgb/000001.jpg");
}

TEST_CASE("layouts: TUM's colour images are found by their times", "[layouts][color]") {
  const TemporaryFolder folder;
  folder.write("depth.txt", "1.00 depth/a.png\n2.00 depth/b.png\n3.00 depth/c.png\n");
  folder.write("rgb.txt",
               "# colour\n0.99 rgb/a.png\n1.005 rgb/a2.png\n2.5 rgb/b.png\n3.01 rgb/c.png\n");
  const layouts::Recording* recording = layouts::find_recording(folder.path());
  REQUIRE(recording);
  const std::vector<SceneFile> frames = recording->frames(folder.path());
  REQUIRE(frames.size() == 3);
  CHECK(frames[0].color == folder / "rgb/a2.png");
  CHECK(frames[1].color.empty());
  CHECK(frames[2].color == folder / "rgb/c.png");
}

TEST_CASE("normals and voxels keep the colours", "[prepare][color]") {
  Cloud cloud;
  cloud.points = PointMatrix::Zero(3, 3);
  cloud.points.col(0) << 0, 0.0005F, 0.1F;
  cloud.normals = PointMatrix::Zero(3, 3);
  cloud.normals.col(2).setOnes();
  cloud.colors = ColorMatrix::Zero(3, 3);
  cloud.colors.col(0) << 0.2F, 0.4F, 1;
  const Cloud small = run_node<Cloud>("downsample_voxels", {}, cloud, Scale{0.01F});
  REQUIRE(small.colors.rows() == 2);
  CHECK(small.colors(0, 0) == Approx(0.3));
  CHECK(small.colors(1, 0) == 1);

  Scan scan;
  scan.points = cloud.points;
  scan.normals = cloud.normals;
  scan.normals.row(1).setZero();
  scan.colors = cloud.colors;
  scan.view.origin = {0, 0, 1};
  const Cloud oriented =
      run_node<Cloud>("estimate_normals", {{"source", "file"}}, scan, Scale{0.01F});
  REQUIRE(oriented.colors.rows() == 2);
  CHECK(oriented.colors(1, 0) == 1);
}

TEST_CASE("sample_surface: samples have the colours of their places", "[train][color]") {
  Mesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  mesh.points *= 0.1F;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3;
  mesh.colors = 10 * mesh.points;  // red is x, green is y
  const Cloud cloud =
      run_node<Cloud>("sample_surface", {{"two_sided", "always"}}, mesh, Scale{0.02F});
  REQUIRE(cloud.colors.rows() == cloud.points.rows());
  CHECK(cloud.colors.isApprox(10 * cloud.points, 1e-4F));
}

}  // namespace posevote::scene_colors_test
