// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/data/hypotheses.hpp"

#include <catch2/catch.hpp>

namespace posevote::hypotheses_test {
namespace {

const Eigen::Vector3f kCenter(0.1F, -0.2F, 0.7F);
const Eigen::Vector3f kModelCenter(0.05F, 0.02F, -0.3F);
const Eigen::Quaternionf kRotation(Eigen::AngleAxisf(2.0F,
                                                     Eigen::Vector3f(1, -2, 0.5F).normalized()));

}  // namespace

TEST_CASE("hypotheses say where the centre lands, poses where the origin does", "[data]") {
  const Eigen::Isometry3d T_scene_model = T_scene_model_of({kCenter, kRotation}, kModelCenter);
  CHECK((posed_center(T_scene_model, kModelCenter) - kCenter.cast<double>()).norm() < 1e-7);
  const Eigen::Vector3d origin = T_scene_model * Eigen::Vector3d::Zero();
  CHECK((origin - (kCenter - kRotation * kModelCenter).cast<double>()).norm() < 1e-6);
}

TEST_CASE("a pose becomes a hypothesis and comes back", "[data]") {
  const Eigen::Isometry3d T_scene_model = T_scene_model_of({kCenter, kRotation}, kModelCenter);
  const Hypothesis pose = hypothesis_of(T_scene_model, kModelCenter, 7);
  CHECK(pose.support == 7);
  CHECK(T_scene_model_of(pose, kModelCenter).isApprox(T_scene_model, 1e-6));
}

}  // namespace posevote::hypotheses_test
