// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/systematic_residual.hpp"

#include <catch2/catch.hpp>

#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::systematic_residual_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

constexpr Eigen::Index kAll = 0;

Eigen::Isometry3d nearer(double metres) {
  Eigen::Isometry3d T = kBody.T_scene_model;
  T.translation().z() -= metres;
  return T;
}

double residual(const SoughtBody& body, const Eigen::Isometry3d& T_scene_model,
                Eigen::Index points = kAll) {
  return systematic_residual(body.sought(), T_scene_model, points).deviation;
}

}  // namespace

TEST_CASE("a pose that is off leaves as much, however noisy the scan is", "[poses]") {
  const float noise = GENERATE(0.F, 0.001F, 0.002F);  // points are 0.003 apart
  INFO("noise " << noise);
  const SoughtBody body({kBody}, 1, noise);
  const double left = residual(body, kBody.T_scene_model);
  CHECK(left < 4e-4);
  CHECK(residual(body, nearer(0.002)) == Approx(0.0017).margin(3e-4));  // of what is oblique less
  CHECK(residual(body, nearer(0.002), 500) == Approx(0.0017).margin(5e-4));
}

TEST_CASE("what was explained, lies far away or beside the surface leaves nothing", "[poses]") {
  SoughtBody body({kBody});
  CHECK(residual(body, beside(0.5)) == 0);
  REQUIRE(residual(body, nearer(0.002)) > 1e-3);
  body.scan.take_out(body.model, kBody.T_scene_model, 2 * kResolution);
  CHECK(residual(body, nearer(0.002)) == 0);
}

}  // namespace posevote::systematic_residual_test
