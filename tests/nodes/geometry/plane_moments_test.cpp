// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/plane_moments.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <vector>

#include "tests/support/instruction_set.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::plane_moments_test {
namespace {

constexpr Eigen::Index kPoints = 500;
constexpr float kRadius = 0.6F;
const float kCenter[3] = {0.1F, -0.2F, 0.05F};
const std::vector<geometry::GridRun> kRuns{{3, 4}, {10, 60}, {60, 61}, {100, 493}, {499, 500}};

/// Scattered in a ball of radius 1, padded.
const PointMatrix& points() {
  static const PointMatrix all =
      test::shaken(PointMatrix::Zero(kPoints + Eigen::Index(geometry::kGridPadding), 3), 1);
  return all;
}

float weight_of(Eigen::Index i) { return 1 + static_cast<float>(i % 7); }

geometry::PlaneMoments sums() {
  std::vector<float> weights(kPoints + geometry::kGridPadding);
  for (Eigen::Index i = 0; i < kPoints; ++i) weights[static_cast<std::size_t>(i)] = weight_of(i);
  const PointMatrix& p = points();
  return geometry::plane_moments(
      {p.col(0).data(), p.col(1).data(), p.col(2).data(), weights.data()}, kRuns.data(),
      kRuns.size(), kCenter, kRadius);
}

}  // namespace

TEST_CASE("plane moments are the weighted sums over the ball", "[prepare]") {
  Eigen::Matrix4d expected = Eigen::Matrix4d::Zero();
  int count = 0;
  for (const geometry::GridRun& run : kRuns)
    for (Eigen::Index i = run.begin; i < run.end; ++i) {
      const Eigen::Vector3d offset =
          (points().row(i).transpose() - Eigen::Vector3f::Map(kCenter)).cast<double>() /
          static_cast<double>(kRadius);
      if (offset.norm() > 1) continue;
      ++count;
      const double weight = weight_of(i) * (1 - 0.999 * offset.squaredNorm());
      expected += weight * offset.homogeneous() * offset.homogeneous().transpose();
    }
  const geometry::PlaneMoments m = sums();
  REQUIRE(count > 30);
  CHECK(static_cast<int>(m.count) == count);
  Eigen::Matrix4d found;
  found << m.xx, m.xy, m.xz, m.x, m.xy, m.yy, m.yz, m.y, m.xz, m.yz, m.zz, m.z, m.x, m.y, m.z,
      m.one;
  CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-5 * expected(3, 3));
}

TEST_CASE("plane moments have the same bits on every instruction set", "[prepare]") {
  const geometry::PlaneMoments best = sums();
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  const geometry::PlaneMoments here = sums();
  CHECK(std::memcmp(&here, &best, sizeof here) == 0);
}

}  // namespace posevote::plane_moments_test
