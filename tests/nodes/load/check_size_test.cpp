// SPDX-License-Identifier: BSD-3-Clause
#include <random>

#include "nodes/data/model.hpp"
#include "tests/nodes/formats/support.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::check_size_test {

using namespace posevote::test;

namespace {

/// Points of a cube with that diagonal.
Scan cube(double diagonal, Eigen::Index count = 2000) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(0, static_cast<float>(diagonal / std::sqrt(3.0)));
  Scan scan;
  scan.points = PointMatrix::NullaryExpr(count, 3, [&] { return place(random); });
  return scan;
}

ModelLibrary library(const std::vector<float>& diagonals) {
  ModelLibrary models;
  for (const float diagonal : diagonals) {
    auto model = std::make_shared<Model>();
    model->diagonal = diagonal;
    models.models.push_back(model);
  }
  return models;
}

std::string size_error(const Scan& scan, const ModelLibrary& models) {
  return error_of([&] { run_node<Scan>("check_size", {}, scan, models); });
}

}  // namespace

TEST_CASE("check_size: sizes that fit pass, unchanged", "[load]") {
  const auto passed = std::make_shared<const Scan>(cube(0.5));
  using Pointer = std::shared_ptr<const Scan>;
  const auto same = run_node<Pointer>("check_size", {}, passed, library({0.2F, 0.4F}));
  CHECK(same == passed);  // the very scan, not a copy of it
  CHECK(size_error(cube(0.15), library({0.3F})) == "(no error)");        // half hidden
  CHECK(size_error(cube(0.15), library({0.1F, 1.5F})) == "(no error)");  // less than the largest
  Scan room = cube(12 * std::sqrt(3.0), 200000);
  room.points.col(2).setZero();
  CHECK(size_error(room, library({0.05F})) == "(no error)");         // a wall, a cup
  CHECK(size_error(cube(0.3, 1), library({0.3F})) != "(no error)");  // one point: no size
}

TEST_CASE("check_size: a factor of 1000 is refused, in both directions", "[load]") {
  for (const double size : {0.25, 0.45, 1.0, 4.0}) {
    CHECK_THAT(size_error(cube(1000 * size), library({0.2F, 0.4F})),
               has("in mm, but read as m? Say --scene-unit mm"));
    CHECK_THAT(size_error(cube(size / 1000), library({0.2F, 0.4F})),
               has("in m, but read as mm? Say --scene-unit m "));
    CHECK_THAT(size_error(cube(size), library({200, 400})), has("Say --model-unit mm"));
    CHECK_THAT(size_error(cube(size), library({0.0002F, 0.0004F})), has("Say --model-unit m "));
  }
  CHECK_THAT(size_error(cube(1400), library({0.2F, 0.4F})),
             has("diagonal is 13") && has(" m, the models' 0.2 m to 0.4 m"));
}

TEST_CASE("check_size: what is too small, or too sparse, to show any model", "[load]") {
  CHECK(size_error(cube(0.1), library({0.4F})) == "(no error)");
  CHECK_THAT(size_error(cube(0.07), library({0.4F})), has("the scan's diagonal is 0.0"));
  CHECK_THAT(size_error(cube(0.04), library({0.4F})), has("Say --scene-unit"));
  Scan wall = cube(100, 20000);  // 58 m wide, a point each 0.4 m
  wall.points.col(2).setZero();
  CHECK(size_error(wall, library({0.6F})) == "(no error)");
  CHECK_THAT(size_error(wall, library({0.2F})),
             has("less than from point to point of the scan: is the scan in mm"));
  Scan image = cube(100);
  image.view.pixels = {640, 480};
  CHECK_THAT(size_error(image, library({0.2F})), has("check depth_scale"));
  CHECK_THAT(size_error(cube(1e6), library({0.2F})), has("check --scene-unit"));
}

TEST_CASE("check_size: stray points change nothing", "[load]") {
  Scan scan = cube(0.5);
  scan.points.topRows(20).setConstant(5000);
  scan.points.bottomRows(10).setConstant(-3e38F);
  CHECK(size_error(scan, library({0.3F})) == "(no error)");
  Scan tiny = cube(0.0005);
  tiny.points.topRows(20).setConstant(0.5);
  CHECK(size_error(tiny, library({0.3F})) != "(no error)");
}

TEST_CASE("check_size: nothing to compare is an error", "[load]") {
  CHECK_THAT(size_error(Scan{}, library({0.3F})), has("no points"));
  CHECK_THAT(size_error(cube(1), ModelLibrary{}), has("library is empty"));
}

}  // namespace posevote::check_size_test
