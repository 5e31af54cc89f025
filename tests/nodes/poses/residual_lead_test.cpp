// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/residual_lead.hpp"

#include <catch2/catch.hpp>

#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::residual_lead_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

double lead(const SoughtBody& body, const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  return residual_lead(body.sought(), one, other);
}

}  // namespace

TEST_CASE("the scan's points speak for the pose on whose surface they lie", "[poses]") {
  const SoughtBody body({kBody});
  const Eigen::Isometry3d turned = beside(0, 0.3);
  const double right = lead(body, kBody.T_scene_model, turned);
  CHECK(right > 2);
  CHECK(lead(body, turned, kBody.T_scene_model) == Approx(-right));
  CHECK(lead(body, turned, beside(0, 0.6)) > 0);  // the nearer of two that are wrong
  CHECK(lead(body, turned, turned) == 0);
}

TEST_CASE("what differs by little, or lies far away, says nothing", "[poses]") {
  SoughtBody body({kBody});
  CHECK(lead(body, kBody.T_scene_model, beside(0.0005)) == 0);
  CHECK(lead(body, beside(0.5), beside(0.6)) == 0);
  const double one = lead(body, kBody.T_scene_model, beside(0, 0.3));
  body.params.terms.twins.least_difference = 1;
  CHECK(lead(body, kBody.T_scene_model, beside(0, 0.3)) < one);
}

TEST_CASE("points that err alike count as so many fewer", "[poses]") {
  SoughtBody body({kBody});
  const double before = lead(body, kBody.T_scene_model, beside(0, 0.3));
  body.params.terms.twins.err_alike *= 4;
  CHECK(lead(body, kBody.T_scene_model, beside(0, 0.3)) == Approx(before / 2));
}

TEST_CASE("what was explained says no more", "[poses]") {
  SoughtBody body({kBody});
  body.scan.take_out(body.model, kBody.T_scene_model, 2 * kResolution);
  CHECK(lead(body, kBody.T_scene_model, beside(0, 0.3)) == 0);
}

}  // namespace posevote::residual_lead_test
