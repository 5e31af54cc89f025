// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/separation.hpp"

#include <catch2/catch.hpp>
#include <random>

namespace posevote::separation_test {

using namespace posevote::poses;

namespace {

using Numbers = std::vector<std::size_t>;

Hypothesis turned(float degrees, float sign = 1) {
  const Eigen::AngleAxisf turn(degrees / 57.29578F, Eigen::Vector3f::UnitZ());
  Hypothesis pose;
  pose.rotation.coeffs() = sign * Eigen::Quaternionf(turn).coeffs();
  return pose;
}

std::vector<Hypothesis> along_x(const std::vector<float>& places) {
  std::vector<Hypothesis> poses;
  for (const float x : places) poses.emplace_back().center.x() = x;
  return poses;
}

}  // namespace

TEST_CASE("non-maximum suppression leaves out what lies within the distance", "[poses]") {
  const std::vector<Hypothesis> poses = along_x({0, 0.5F, 1.5F, 3});
  CHECK(poses::separate_poses(poses, {1.0F, 1, 3}, 9) == Numbers{0, 2, 3});
  CHECK(poses::separate_poses(poses, {1.5F, 1, 3}, 9) == Numbers{0, 3});
  CHECK(poses::separate_poses(poses, {0.1F, 1, 3}, 9) == Numbers{0, 1, 2, 3});
  CHECK(poses::separate_poses(poses, {0.1F, 1, 3}, 2) == Numbers{0, 1});
  CHECK(poses::separate_poses({}, {1, 1, 3}, 9).empty());
}

TEST_CASE("a place may be judged in some quite different rotations", "[poses]") {
  std::vector<Hypothesis> poses;  // of either sign: both name the same rotation
  for (const float degrees : {0.0F, 50.0F, 90.0F, 140.0F, 180.0F, 270.0F})
    poses.push_back(turned(degrees, poses.size() % 2 == 0 ? 1.0F : -1.0F));
  const float sixty = 1.0471976F;
  CHECK(poses::separate_poses(poses, {1.0F, sixty, 3}, 9) == Numbers{0, 2, 4});
  CHECK(poses::separate_poses(poses, {1.0F, sixty, 9}, 9) == Numbers{0, 2, 4, 5});
  CHECK(poses::separate_poses(poses, {1.0F, sixty / 2, 9}, 9) == Numbers{0, 1, 2, 3, 4, 5});
}

TEST_CASE("cells leave out what a comparison of all with all does", "[poses]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-0.1F, 0.1F), degrees(0, 360);
  std::vector<Hypothesis> poses;
  for (int i = 0; i < 600; ++i) {
    poses.push_back(turned(degrees(random)));
    poses.back().center = {place(random), place(random), place(random)};
  }
  const Separation separation{0.05F, 0.7F, 4};
  Numbers expected;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    int here = 0;
    bool like = false;
    for (const std::size_t j : expected) {
      like = like || is_like(poses[i], poses[j], separation);
      here += (poses[i].center - poses[j].center).norm() <= separation.distance ? 1 : 0;
    }
    if (!like && here < separation.per_place) expected.push_back(i);
  }
  CHECK(expected.size() > 50);
  CHECK(separate_poses(poses, separation, 600) == expected);
}

TEST_CASE("poses are alike that neither lie apart nor are turned", "[poses]") {
  Hypothesis away = turned(20);
  away.center.x() = 1;
  CHECK(poses::is_like(turned(0), turned(20), {0.5F, 0.5F, 1}));
  CHECK_FALSE(poses::is_like(turned(0), turned(40), {0.5F, 0.5F, 1}));
  CHECK_FALSE(poses::is_like(turned(0), away, {0.5F, 0.5F, 1}));
  CHECK(poses::is_like(turned(0), away, {1, 0.5F, 1}));
}

}  // namespace posevote::separation_test
