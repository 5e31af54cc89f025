// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "nodes/data/model.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::find_symmetries_test {

using namespace posevote::test;

namespace {

constexpr float kStep = 0.003F;

/// The side of a box at `place` along `axis`, which spans [low, high] along the others.
void add_side(std::vector<Eigen::RowVector3f>& points, std::vector<Eigen::RowVector3f>& normals,
              int axis, const Eigen::RowVector3f& low, const Eigen::RowVector3f& high, bool upper) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (float a = low[u]; a <= high[u]; a += kStep)
    for (float b = low[v]; b <= high[v]; b += kStep) {
      Eigen::RowVector3f p = Eigen::RowVector3f::Zero(), n = Eigen::RowVector3f::Zero();
      p[axis] = upper ? high[axis] : low[axis];
      p[u] = a, p[v] = b;
      n[axis] = upper ? 1.0F : -1.0F;
      points.push_back(p), normals.push_back(n);
    }
}

/// A box of 60 x 90 x 150 mm, with a knob on its top that is as wide as long [m], or without.
Cloud carton(float knob) {
  std::vector<Eigen::RowVector3f> points, normals;
  const auto add_box = [&](const Eigen::RowVector3f& low, const Eigen::RowVector3f& high) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) add_side(points, normals, axis, low, high, upper);
  };
  add_box({-0.03F, -0.045F, -0.075F}, {0.03F, 0.045F, 0.075F});
  if (knob > 0) add_box({0.0F, 0.0F, 0.075F}, {knob, knob, 0.095F});
  Cloud cloud;
  cloud.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  cloud.normals.resize(cloud.points.rows(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.points.row(static_cast<Eigen::Index>(i)) = points[i];
    cloud.normals.row(static_cast<Eigen::Index>(i)) = normals[i];
  }
  return cloud;
}

NearSymmetries near_of(const std::vector<graph::Value>& outputs) {
  return *std::static_pointer_cast<const NearSymmetries>(outputs.at(1));
}

Symmetries exact_symmetries_of(const Cloud& cloud) {
  return run_node<Symmetries>("find_symmetries", {}, cloud, Scale{kStep});
}

/// A cup without a handle: a cylinder of 40 x 100 mm (radius, height) and one of its two ends.
Cloud cup(bool both_ends) {
  std::vector<Eigen::RowVector3f> points, normals;
  const auto around = static_cast<int>(2 * std::numbers::pi * 0.04 / kStep);
  for (int k = 0; k < around; ++k) {
    const float angle = static_cast<float>(2 * std::numbers::pi * k / around);
    const Eigen::RowVector3f out(std::cos(angle), std::sin(angle), 0);
    for (float z = 0; z <= 0.1F; z += kStep) {
      points.push_back(0.04F * out + Eigen::RowVector3f(0.2F, 0, z));
      normals.push_back(out);
    }
  }
  for (float x = -0.04F; x <= 0.04F; x += kStep)
    for (float y = -0.04F; y <= 0.04F; y += kStep) {
      if (std::hypot(x, y) > 0.04F) continue;
      points.push_back({x + 0.2F, y, 0});
      normals.push_back({0, 0, -1});
      if (!both_ends) continue;
      points.push_back({x + 0.2F, y, 0.1F});
      normals.push_back({0, 0, 1});
    }
  Cloud cloud{PointMatrix(points.size(), 3), PointMatrix(points.size(), 3), {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.points.row(static_cast<Eigen::Index>(i)) = points[i];
    cloud.normals.row(static_cast<Eigen::Index>(i)) = normals[i];
  }
  return cloud;
}

/// With a bar beside the axis of a cup, at x [m]: four points wide, and so many rows of them up from z.
Cloud with_bar(Cloud cup, float z, Eigen::Index rows, float x = 0.23F) {
  const Eigen::Index body = cup.points.rows(), bar = 4 * rows;
  cup.points.conservativeResize(body + bar, 3), cup.normals.conservativeResize(body + bar, 3);
  for (Eigen::Index i = 0; i < bar; ++i) {
    cup.points.row(body + i) << x, kStep * static_cast<float>(i % 4),
        z + kStep * static_cast<float>(i / 4);
    cup.normals.row(body + i) << 1, 0, 0;
  }
  return cup;
}

std::vector<NearSymmetry> symmetries_of(const Cloud& cloud,
                                        const std::map<std::string, std::string>& values = {}) {
  return near_of(run_outputs("find_symmetries", values, cloud, Scale{kStep})).items;
}

}  // namespace

TEST_CASE("a carton with a knob is nearly itself after three half turns", "[match]") {
  const Cloud cloud = carton(0.025F);
  const auto symmetries = symmetries_of(cloud);
  REQUIRE(symmetries.size() == 3);
  for (const auto& [motion, carried_off, uncovered] : symmetries) {
    const Eigen::AngleAxisd turn(motion.linear());
    CHECK(turn.angle() == Approx(std::numbers::pi).margin(0.02));
    CHECK(turn.axis().cwiseAbs().maxCoeff() > 0.999);
    // The box comes to lie on itself, not the bounding box, which the knob makes longer.
    CHECK((motion * Eigen::Vector3d(0, 0, 0)).norm() < 0.002);
    // They differ by the knob: most of it is carried away, and nothing takes its place.
    for (const auto* differing : {&carried_off, &uncovered}) {
      CHECK(differing->size() > 100);
      for (const std::uint32_t i : *differing) CHECK(cloud.points(i, 2) > 0.075F);
    }
  }
}

TEST_CASE("what no one can tell apart is no near symmetry", "[match]") {
  CHECK(symmetries_of(carton(0)).empty());
}

TEST_CASE("a free-form body has none", "[match]") {
  Cloud body = bumpy_cloud(1, 0.002F);
  const auto outputs = run_outputs("find_symmetries", {}, body, Scale{0.001F});
  CHECK(near_of(outputs).items.empty());
  const Symmetries exact = *std::static_pointer_cast<const Symmetries>(outputs.at(0));
  CHECK_FALSE(exact.any());
  CHECK(exact.turns.size() == 1);
}

TEST_CASE("near symmetries can be limited, and searched for in nothing", "[match]") {
  CHECK(symmetries_of(carton(0.025F), {{"most", "1"}}).size() == 1);
  CHECK(symmetries_of(carton(0.025F), {{"most", "0"}}).empty());
  CHECK(symmetries_of(carton(0.025F), {{"least", "0.99"}}).empty());
  CHECK(symmetries_of(Cloud{}).empty());
}

TEST_CASE("a box is itself after three half turns about its middle", "[match]") {
  const Symmetries box = exact_symmetries_of(carton(0));
  CHECK(box.axes.empty());
  CHECK(box.fixed_point.norm() < 0.002F);
  REQUIRE(box.turns.size() == 4);
  CHECK(box.turns[0].coeffs() == Eigen::Quaternionf::Identity().coeffs());
  for (std::size_t i = 1; i < 4; ++i) {
    CHECK(std::abs(box.turns[i].w()) < 0.02F);
    CHECK(box.turns[i].vec().cwiseAbs().maxCoeff() > 0.999F);
  }
  CHECK_FALSE(exact_symmetries_of(carton(0.025F)).any());
}

TEST_CASE("a pin of half a hundredth of the surface tells which way round a box lies", "[match]") {
  const Cloud cloud = carton(0.006F);
  CHECK_FALSE(exact_symmetries_of(cloud).any());
  const auto symmetries = symmetries_of(cloud);
  CHECK(symmetries.size() == 3);
  for (const auto& [motion, carried_off, uncovered] : symmetries) {
    CHECK(carried_off.size() < static_cast<std::size_t>(cloud.points.rows() / 100));
    CHECK_FALSE(carried_off.empty());
  }
}

TEST_CASE("a can with such a pin is still round", "[match]") {
  const Cloud can = with_bar(cup(true), 0.1F + 3 * kStep, 2);
  const Symmetries found = exact_symmetries_of(can);
  CHECK(found.axes.size() == 1);
  CHECK(found.turns.size() == 1);  // but does not stand on its head
  const auto near = symmetries_of(can);
  REQUIRE(near.size() == 1);
  CHECK(std::abs(Eigen::AngleAxisd(near[0].motion.linear()).axis().z()) < 0.05);
}

TEST_CASE("of a cup with a handle all turns about its axis are looked at, evenly", "[match]") {
  const Cloud mug = with_bar(cup(false), 0.01F, 27, 0.26F);
  REQUIRE(exact_symmetries_of(mug).axes.empty());
  auto near = symmetries_of(mug);
  REQUIRE(near.size() >= 17);
  near.resize(17);  // others stand it on its head
  std::vector<double> angles;
  for (const auto& [motion, carried_off, uncovered] : near) {
    const Eigen::AngleAxisd turn(motion.linear());
    CHECK(std::abs(turn.axis().z()) > 0.9999);
    const bool is_down = turn.axis().z() < 0;
    angles.push_back(is_down ? 2 * std::numbers::pi - turn.angle() : turn.angle());
    const Eigen::Vector3d on_axis(0.2, 0, 0.05);
    CHECK((motion * on_axis - on_axis).norm() < 0.001);
    CHECK(carried_off.size() >= 4 * 27 * 2 / 3);  // the handle
  }
  std::ranges::sort(angles);
  for (std::size_t i = 0; i < angles.size(); ++i)
    CHECK(angles[i] == Approx(2 * std::numbers::pi * static_cast<double>(i + 1) / 18));
  CHECK(symmetries_of(mug, {{"nearly_round", "1"}}).size() <= 12);
}

TEST_CASE("a cube is itself after 24 turns", "[match]") {
  std::vector<Eigen::RowVector3f> points, normals;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      add_side(points, normals, axis, Eigen::RowVector3f::Constant(-0.045F),
               Eigen::RowVector3f::Constant(0.045F), upper);
  Cloud cube{PointMatrix(points.size(), 3), PointMatrix(points.size(), 3), {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    cube.points.row(static_cast<Eigen::Index>(i)) = points[i];
    cube.normals.row(static_cast<Eigen::Index>(i)) = normals[i];
  }
  const Symmetries found = exact_symmetries_of(cube);
  CHECK(found.turns.size() == 24);
  CHECK(found.axes.empty());
}

TEST_CASE("a cup has an axis, a closed can may stand on its head, too", "[match]") {
  for (const bool closed : {false, true}) {
    const Symmetries found = exact_symmetries_of(cup(closed));
    REQUIRE(found.axes.size() == 1);
    CHECK(std::abs(found.axes[0].z()) > 0.9999F);
    CHECK(found.fixed_point.x() == Approx(0.2F).margin(0.001));
    CHECK(found.turns.size() == (closed ? 2 : 1));
    if (closed) CHECK(std::abs(found.turns[1].z()) < 0.01F);
    if (closed) CHECK(std::abs(found.turns[1].w()) < 0.01F);
  }
}

TEST_CASE("a ball has all axes", "[match]") {
  const PointMatrix points = sphere(4000, 0.05F);
  const Symmetries ball = exact_symmetries_of({points, points / 0.05F, {}});
  CHECK(ball.axes.size() == 2);
  CHECK(ball.turns.size() == 1);
  CHECK(ball.fixed_point.norm() < 0.001F);
}

}  // namespace posevote::find_symmetries_test
