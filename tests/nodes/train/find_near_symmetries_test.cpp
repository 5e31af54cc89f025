// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <numbers>

#include "nodes/data/model.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

using namespace posevote;
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

/// A box of 60 x 90 x 150 mm, with a knob on its top or without.
Cloud carton(bool knob) {
  std::vector<Eigen::RowVector3f> points, normals;
  const auto add_box = [&](const Eigen::RowVector3f& low, const Eigen::RowVector3f& high) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) add_side(points, normals, axis, low, high, upper);
  };
  add_box({-0.03F, -0.045F, -0.075F}, {0.03F, 0.045F, 0.075F});
  if (knob) add_box({0.0F, 0.0F, 0.075F}, {0.02F, 0.03F, 0.095F});
  Cloud cloud;
  cloud.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  cloud.normals.resize(cloud.points.rows(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.points.row(static_cast<Eigen::Index>(i)) = points[i];
    cloud.normals.row(static_cast<Eigen::Index>(i)) = normals[i];
  }
  return cloud;
}

std::vector<NearSymmetry> symmetries_of(const Cloud& cloud,
                                        const std::map<std::string, std::string>& values = {}) {
  return run_node<NearSymmetries>("find_near_symmetries", values, cloud, Scale{kStep}).items;
}

}  // namespace

TEST_CASE("a carton with a knob is nearly itself after three half turns", "[match]") {
  const Cloud cloud = carton(true);
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
  CHECK(symmetries_of(carton(false)).empty());
}

TEST_CASE("a free-form body has none", "[match]") {
  Cloud body = bumpy_cloud(1, 0.002F);
  CHECK(run_node<NearSymmetries>("find_near_symmetries", {}, body, Scale{0.001F}).items.empty());
}

TEST_CASE("near symmetries can be limited, and searched for in nothing", "[match]") {
  CHECK(symmetries_of(carton(true), {{"most", "1"}}).size() == 1);
  CHECK(symmetries_of(carton(true), {{"most", "0"}}).empty());
  CHECK(symmetries_of(carton(true), {{"least", "0.99"}}).empty());
  CHECK(symmetries_of(Cloud{}).empty());
}
