// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "nodes/data/files.hpp"
#include "tests/nodes/formats/support.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::load_scene_test {

using namespace posevote::test;

TEST_CASE("load_scene: point files in mm and m", "[load]") {
  const TempDir dir;
  SceneFile scene;
  scene.path = dir.write("scan.obj", "v 100 200 300\n");
  CHECK(run_node<Scan>("load_scene", {}, scene).points(0, 2) == 300);
  CHECK(run_node<Scan>("load_scene", {{"unit", "mm"}}, scene).points(0, 2) == Approx(0.3));
  CHECK_THROWS_AS(run_node<Scan>("load_scene", {{"unit", "inch"}}, scene), std::invalid_argument);
}

TEST_CASE("load_scene: scans from memory are as those from files", "[load]") {
  const TempDir dir;
  SceneFile file, memory;
  file.path = dir.write("scan.obj", "v 100 200 300\nv 110 200 300\n");
  LoadedPoints loaded;
  loaded.scan.points = (PointMatrix(2, 3) << 100, 200, 300, 110, 200, 300).finished();
  memory.points = std::make_shared<const LoadedPoints>(loaded);
  const std::map<std::string, std::string> mm{{"unit", "mm"}};
  CHECK(run_node<Scan>("load_scene", mm, memory).points ==
        run_node<Scan>("load_scene", mm, file).points);
  CHECK(run_node<Scan>("load_scene", mm, memory).view.origin.isZero());
  loaded.knows_sensor = true;
  loaded.scan.view.origin = {1000, 0, 0};
  memory.points = std::make_shared<const LoadedPoints>(loaded);
  CHECK(run_node<Scan>("load_scene", mm, memory).view.origin.x() == 1);

  SceneFile png, image;
  png.path = dir.write("depth.png", depth_png(2, 1, {0, 1000}));
  png.camera = image.camera = Camera{10, 10, 0.5, 0.5, 1};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float none : {0.0F, nan, std::numeric_limits<float>::infinity()}) {
    image.depth = std::make_shared<const LoadedDepth>(LoadedDepth{2, 1, {none, 1}});
    CHECK(run_node<Scan>("load_scene", {}, image).points ==
          run_node<Scan>("load_scene", {}, png).points);
  }
}

TEST_CASE("load_scene: the data set's camera goes before the parameters", "[load]") {
  const TempDir dir;
  SceneFile scene;
  scene.path = dir.write("depth.PNG", depth_png(2, 1, {0, 1000}));
  CHECK_THAT(error_of([&] { run_node<Scan>("load_scene", {}, scene); }), has("load_scene.fx"));
  const std::map<std::string, std::string> params{{"fx", "10"},         {"fy", "10"},
                                                  {"cx", "0.5"},        {"cy", "0.5"},
                                                  {"depth_scale", "2"}, {"unit", "mm"}};
  const Scan by_params = run_node<Scan>("load_scene", params, scene);
  CHECK(by_params.points.row(0).isApprox(Eigen::RowVector3f(0.1F, -0.1F, 2)));
  scene.camera = Camera{10, 10, 0.5, 0.5, 1};
  const Scan by_camera = run_node<Scan>("load_scene", params, scene);
  CHECK(by_camera.points.row(0).isApprox(Eigen::RowVector3f(0.05F, -0.05F, 1)));
  CHECK_THAT(error_of([&] {
               run_node<Scan>("load_scene", {{"max_depth", "0.5"}}, scene);
             }),
             has("none of the image's 2 pixels"));
  CHECK_THAT(error_of([&] {
               run_node<Scan>("load_scene", {{"min_depth", "1.5"}}, scene);
             }),
             has("none of the image's 2 pixels"));
}

TEST_CASE("load_scene: the sensor's place is said, beside the file, in it, or the origin",
          "[load]") {
  const TempDir dir;
  const auto place = [](const SceneFile& scene, const std::map<std::string, std::string>& params) {
    return run_node<Scan>("load_scene", params, scene).view.origin;
  };
  SceneFile ply, pcd;
  ply.path = dir.write("a.obj", "v 100 200 300\n");
  pcd.path = dir.write("b.pcd",
                       "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\n"
                       "HEIGHT 1\nVIEWPOINT 10 20 30 1 0 0 0\nPOINTS 1\nDATA ascii\n1 2 3\n");
  CHECK(place(ply, {}).isZero());
  CHECK(place(pcd, {{"unit", "mm"}}).isApprox(Eigen::Vector3f(0.01F, 0.02F, 0.03F)));
  dir.write("a.pose", "1 0 0 4\n0 1 0 5\n0 0 1 6\n0 0 0 1\n");
  dir.write("b.pose", "4 5 6\n");
  for (const SceneFile& scene : {ply, pcd}) {
    CHECK(place(scene, {{"unit", "cm"}}).isApprox(Eigen::Vector3f(0.04F, 0.05F, 0.06F)));
    CHECK(place(scene, {{"sensor_pose", "[7, 8, 9]"}}) == Eigen::Vector3f(7, 8, 9));
  }
}

TEST_CASE("load_scene: a sensor's pose that cannot be used", "[load]") {
  const TempDir dir;
  SceneFile scene;
  scene.path = dir.write("a.obj", "v 100 200 300\n");
  dir.write("a.pose", "1 2 3 4 5 6\n");
  const std::string error = error_of([&] { run_node<Scan>("load_scene", {}, scene); });
  CHECK_THAT(error, has("a.pose: the sensor's pose has 6 numbers"));
  dir.write("a.pose", "1e39 0 0\n");
  CHECK_THAT(error_of([&] { run_node<Scan>("load_scene", {}, scene); }), has("too far away"));
  std::filesystem::remove(dir.path("a.pose"));
  std::filesystem::create_symlink(dir.path("nowhere"), dir.path("a.pose"));
  CHECK_THAT(error_of([&] { run_node<Scan>("load_scene", {}, scene); }), has("dangling link"));
  const graph::NodeSpec* spec = graph::find_node("load_scene");
  REQUIRE(spec);
  const auto params = spec->make_params();
  for (const graph::ParamSpec& param : spec->params)
    if (param.name == "sensor_pose") {
      CHECK(param.set(params.get(), "[1, 2, nan]"));
      CHECK_FALSE(param.set(params.get(), "[1, 2]"));
    }
  CHECK_THAT(spec->check(params.get()), has("has 2 numbers"));
  scene.path = dir.write("depth.png", depth_png(2, 1, {0, 1000}));
  scene.camera = Camera{10, 10, 0.5, 0.5, 1};
  dir.write("depth.pose", "1 2 3\n");  // many data sets have the camera's pose in the world there
  CHECK(run_node<Scan>("load_scene", {}, scene).view.origin.isZero());
  CHECK_THAT(error_of([&] {
               run_node<Scan>("load_scene", {{"sensor_pose", "[1, 2, 3]"}}, scene);
             }),
             has("--sensor-pose"));
}

TEST_CASE("load_scene: limits that exclude each other", "[load]") {
  const graph::NodeSpec* spec = graph::find_node("load_scene");
  REQUIRE(spec);
  const auto params = spec->make_params();
  CHECK(spec->check(params.get()).empty());
  for (const graph::ParamSpec& param : spec->params) {
    if (param.name == "min_depth") param.set(params.get(), "2");
    if (param.name == "max_depth") param.set(params.get(), "1");
  }
  CHECK_THAT(spec->check(params.get()), has("max_depth"));
}

TEST_CASE("load_scene: a missing file", "[load]") {
  const TempDir dir;
  for (const char* name : {"none.ply", "none.png"}) {
    SceneFile scene;
    scene.path = dir.path(name);
    scene.camera = Camera{10, 10, 0.5, 0.5, 1};
    CHECK(error_of([&] { run_node<Scan>("load_scene", {}, scene); }) == "there is no such file");
  }
}

}  // namespace posevote::load_scene_test
