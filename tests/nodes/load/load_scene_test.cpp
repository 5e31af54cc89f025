// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/data/files.hpp"
#include "tests/nodes/formats/support.hpp"
#include "tests/support/run_node.hpp"

using namespace posevote;
using namespace posevote::test;

TEST_CASE("load_scene: point files in mm and m", "[load]") {
  const TempDir dir;
  SceneFile scene;
  scene.path = dir.write("scan.obj", "v 100 200 300\n");
  CHECK(run_node<Scan>("load_scene", {}, scene).points(0, 2) == 300);
  CHECK(run_node<Scan>("load_scene", {{"unit", "mm"}}, scene).points(0, 2) == Approx(0.3));
  CHECK_THROWS_AS(run_node<Scan>("load_scene", {{"unit", "inch"}}, scene), std::invalid_argument);
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
