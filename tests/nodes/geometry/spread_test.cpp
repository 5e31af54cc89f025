// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/spread.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "tests/support/votes.hpp"

namespace posevote::spread_test {
namespace {

Eigen::Matrix3d turned(const Eigen::Vector3d& eigenvalues, std::mt19937& random) {
  const Eigen::Matrix3d R = test::random_rotation(random).toRotationMatrix().cast<double>();
  return R * eigenvalues.asDiagonal() * R.transpose();
}

}  // namespace

TEST_CASE("the two least spreads are Eigen's smallest eigenvalues, the least's way its vector",
          "[prepare]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::pow(10, 6 * uniform(random) - 6);
    const Eigen::Vector3d values(0.2 * std::pow(uniform(random), 4), 0.3 + 0.7 * uniform(random),
                                 1);
    const Eigen::Matrix3d covariance = turned(scale * values, random);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const geometry::Spread spread = geometry::spread_of(covariance);
    REQUIRE(std::abs(spread.least - solver.eigenvalues()[0]) < 1e-9 * scale);
    REQUIRE(std::abs(spread.second - solver.eigenvalues()[1]) < 1e-7 * scale);
    const double cosine = spread.across.normalized().dot(solver.eigenvectors().col(0));
    REQUIRE(std::abs(cosine) > 1 - 1e-10);
  }
}

TEST_CASE("the least spread is right where eigenvalues coincide", "[prepare]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.01, 1);
  for (int i = 0; i < 20000; ++i) {
    const double low = uniform(random);
    const Eigen::Vector3d values(low, low, i % 2 == 0 ? low : 1);
    const geometry::Spread spread = geometry::spread_of(turned(values, random));
    REQUIRE(std::abs(spread.least - low) < 1e-4);
  }
  CHECK(geometry::spread_of(Eigen::Matrix3d::Identity()).least == Approx(1).margin(1e-4));
}

TEST_CASE("points on a line, in one place or nowhere spread across nothing", "[prepare]") {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i)
    CHECK(geometry::spread_of(turned({0, 0.5e-4, 1}, random)).across.isZero());
  CHECK(geometry::spread_of(Eigen::Matrix3d::Zero()).across.isZero());
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    CHECK(geometry::spread_of(Eigen::Matrix3d::Constant(bad)).across.isZero());
}

}  // namespace posevote::spread_test
