// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/nodes/describe/described_body.hpp"

namespace posevote::describe_ecsad_test {

using namespace posevote::test;

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// The origin looks up; its neighbours stand at height(x, y) over a disc of radius 4.
template <class Height>
Cloud relief(const Height& height, float turn) {
  std::vector<Eigen::RowVector3f> points{{0, 0, 0}};
  for (float r = 0.05F; r < 3.9F; r += 0.1F)
    for (float phi = 0.001F; phi < 2 * kPi; phi += 0.05F) {
      const float x = r * std::cos(phi), y = r * std::sin(phi);
      points.emplace_back(std::cos(turn) * x - std::sin(turn) * y,
                          std::sin(turn) * x + std::cos(turn) * y, height(x, y));
    }
  Cloud cloud;
  const auto count = static_cast<Eigen::Index>(points.size());
  cloud.points.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i)
    cloud.points.row(i) = points[static_cast<std::size_t>(i)];
  cloud.normals = Eigen::RowVector3f(0, 0, 1).replicate(count, 1);
  return cloud;
}

/// Shells are 1 m thick.
Eigen::RowVectorXf describe_origin(const Cloud& cloud) {
  return run_node<FeatureSet>("describe_ecsad", {{"radius", "4"}, {"min_neighbours", "1"}}, cloud,
                              FeaturePoints{{0}}, Scale{1})
      .descriptors;
}

float roof(float x, float) { return -std::abs(x); }  // its edge is the y axis

}  // namespace

TEST_CASE("ECSAD: along an edge nothing falls, across it everything does", "[describe]") {
  for (const float turn : {0.0F, 0.4F, 1.9F}) {
    INFO(turn);
    const auto d = describe_origin(relief(roof, turn));
    REQUIRE(d.size() == 30);
    // The outermost shell's 12 pairs of sectors begin at element 18; the first has the edge in its
    // middle, the seventh lies across.
    CHECK(std::abs(d[18]) < 0.1F);
    CHECK(d[24] == Approx(-kPi / 4).margin(0.02));
    CHECK(d[19] == Approx(d[29]).margin(0.03));  // both sides of the edge are alike
    CHECK(std::abs(d[0]) > std::abs(d[18]));     // of 60 deg, not of 15
  }
}

TEST_CASE("ECSAD: a dent is the opposite of a bump", "[describe]") {
  const auto bump = describe_origin(relief(roof, 0));
  const auto dent = describe_origin(relief([](float x, float y) { return -roof(x, y); }, 0));
  CHECK(dent.isApprox(-bump, 1e-3F));
}

TEST_CASE("ECSAD: shells tell near from far", "[describe]") {
  // Flat within 2 m, then falling.
  const auto d = describe_origin(
      relief([](float x, float y) { return std::hypot(x, y) < 2 ? 0 : 2 - std::hypot(x, y); }, 0));
  CHECK(d.head(9).norm() < 1e-3F);  // 3 + 6 numbers of the two inner shells
  CHECK(d.segment(9, 9).mean() < -0.1F);
  CHECK(d.tail(12).mean() < d.segment(9, 9).mean() - 0.1F);
}

TEST_CASE("ECSAD: what is not seen takes the mean of its shell", "[describe]") {
  Cloud half = relief([](float, float) { return 0.0F; }, 0);
  half.points.col(2).array() += 0.01F;
  half.points.row(0).setZero();
  const auto whole = describe_origin(half);
  for (Eigen::Index i = 1; i < half.points.rows(); ++i)
    if (std::abs(half.points(i, 0)) > 0.7F * std::abs(half.points(i, 1)))
      half.points.row(i).setConstant(50);
  CHECK((describe_origin(half) - whole).cwiseAbs().maxCoeff() < 0.05F);
}

}  // namespace posevote::describe_ecsad_test
