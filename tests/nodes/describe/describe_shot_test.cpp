// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/nodes/describe/described_body.hpp"

namespace posevote::describe_shot_test {

using namespace posevote::test;

TEST_CASE("SHOT: descriptors are of unit length, and a mirror changes them", "[describe]") {
  const Cloud body = bumpy_cloud(2, kResolution);
  const FeatureSet still = described("describe_shot", body, 11, {{"radius", "8"}});
  for (const auto& row : still.descriptors.rowwise()) CHECK(row.norm() == Approx(1).margin(1e-4));
  const Eigen::Affine3f mirror(Eigen::Vector3f(1, 1, -1).asDiagonal());
  const FeatureSet mirrored =
      described("describe_shot", moved(body, mirror), 11, {{"radius", "8"}});
  CHECK(typical_difference(still, mirrored) > 0.05F);
}

}  // namespace posevote::describe_shot_test
