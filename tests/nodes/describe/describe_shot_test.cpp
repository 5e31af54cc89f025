// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/nodes/describe/described_body.hpp"

using namespace posevote;
using namespace posevote::test;

namespace {

const std::string kNode = "describe_shot";
const std::map<std::string, std::string> kRadius = {{"radius", "8"}};

}  // namespace

TEST_CASE("SHOT: turning a body changes nothing", "[describe]") {
  const Cloud body = bumpy_cloud(2, kResolution);
  const Eigen::Affine3f turn(Eigen::AngleAxisf(2.1F, Eigen::Vector3f(1, -2, 0.5F).normalized()));
  const FeatureSet still = described(kNode, body, 11, kRadius);
  CHECK(still.descriptors.cols() == 352);
  CHECK(still.descriptors.row(3).norm() == Approx(1).margin(1e-4));
  CHECK(typical_difference(still, described(kNode, moved(body, turn), 11, kRadius)) < 0.01F);
}

TEST_CASE("SHOT: a body finds itself again", "[describe]") {
  CHECK(self_match_rate(kNode, 0, kRadius) > 0.7);
}

TEST_CASE("SHOT: a feature point's descriptor does not depend on its chunk", "[describe]") {
  const Cloud body = bumpy_cloud(2, kResolution);
  const FeatureSet all = described(kNode, body, 3, kRadius);
  const FeatureSet some = described(kNode, body, 9, kRadius);
  for (Eigen::Index i = 0; i < some.descriptors.rows(); ++i)
    CHECK(some.descriptors.row(i) == all.descriptors.row(3 * i));
}
