// SPDX-License-Identifier: BSD-3-Clause
// Noise is averaged, motion is not.
#include "nodes/poses/steady.hpp"

#include <catch2/catch.hpp>

namespace posevote::steady_test {

using geometry::Matrix6d;
using geometry::Vector6d;
using poses::UncertainPose;

namespace {

constexpr double kDeviation = 0.001;

UncertainPose at(double x) {
  return {Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0.8)),
          kDeviation * kDeviation * Matrix6d::Identity()};
}

double place(const UncertainPose& pose) { return pose.T_scene_model.translation().x(); }

}  // namespace

TEST_CASE("of two equally uncertain poses the mean is taken, and is surer", "[steady]") {
  const UncertainPose held = poses::steady(at(0), at(0.001), {0, 12.6});
  CHECK(place(held) == Approx(0.0005));
  CHECK(held.covariance(0, 0) == Approx(0.5 * kDeviation * kDeviation));
  CHECK((held.covariance - held.covariance.transpose()).norm() == 0);
}

TEST_CASE("the longer it stands still, the less the next frame counts, to a limit", "[steady]") {
  UncertainPose held = at(0);
  for (int frame = 0; frame < 100; ++frame) held = poses::steady(held, at(0), {0.05, 12.6});
  const double moved = place(poses::steady(held, at(0.001), {0.05, 12.6})) / 0.001;
  CHECK(moved == Approx(0.2).margin(0.01));
}

TEST_CASE("a motion is followed at once, and the past is forgotten", "[steady]") {
  UncertainPose held = at(0);
  for (int frame = 0; frame < 20; ++frame) held = poses::steady(held, at(0), {0.05, 12.6});
  const UncertainPose moved = poses::steady(held, at(0.01), {0.05, 12.6});
  CHECK(place(moved) == 0.01);
  CHECK(moved.covariance == at(0.01).covariance);
}

TEST_CASE("a direction that nothing holds does not loosen the others", "[steady]") {
  UncertainPose before = at(0), measured = at(0.0005);
  before.covariance(5, 5) = measured.covariance(5, 5) = 3;
  measured.T_scene_model.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  const UncertainPose held = poses::steady(before, measured, {0.05, 12.6});
  CHECK(place(held) == Approx(0.00025).margin(2e-5));
  CHECK(Eigen::AngleAxisd(held.T_scene_model.linear()).angle() == Approx(0.25).margin(0.02));
}

}  // namespace posevote::steady_test
