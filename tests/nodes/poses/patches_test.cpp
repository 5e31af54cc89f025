// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/patches.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace posevote::patches_test {
namespace {

constexpr int kSide = 60;  // points along each side of a square metre

Eigen::Matrix3Xf square() {
  Eigen::Matrix3Xf points(3, kSide * kSide);
  for (int i = 0; i < points.cols(); ++i)
    points.col(i) << static_cast<float>(i % kSide) / kSide, static_cast<float>(i / kSide) / kSide,
        0;
  return points;
}

Eigen::VectorXd noise(Eigen::Index count, double deviation) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, deviation);
  return Eigen::VectorXd::NullaryExpr(count, [&] { return normal(random); });
}

}  // namespace

TEST_CASE("noise is no part of what patches share, a warp is", "[poses]") {
  const Eigen::Matrix3Xf points = square();
  const Eigen::VectorXd rough = noise(points.cols(), 1);
  CHECK(poses::shared_deviation(points, rough, 0.1F).deviation < 0.1);
  Eigen::VectorXd warp(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    warp[i] = 0.5 * std::sin(2 * M_PI * static_cast<double>(points(0, i)));
  CHECK(poses::shared_deviation(points, rough + warp, 0.1F).deviation ==
        Approx(0.5 / std::sqrt(2)).epsilon(0.1));
  CHECK(poses::shared_deviation(points, Eigen::VectorXd::Constant(points.cols(), -0.3), 0.1F)
            .deviation == Approx(0.3));  // all of it lies off
}

TEST_CASE("what noise leaves in patches is told as their doubt", "[poses]") {
  const Eigen::Matrix3Xf points = square();
  constexpr int kTimes = 200;
  double squared = 0, told = 0;
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0, 1);
  for (int i = 0; i < kTimes; ++i) {
    const auto all =
        Eigen::VectorXd::NullaryExpr(points.cols(), [&] { return normal(random); }).eval();
    const poses::Shared shared = poses::shared_deviation(points, all, 0.1F);
    squared += std::pow(shared.deviation, 4);  // of positive estimates, which are half of them
    told += std::pow(shared.doubt, 4);
  }
  CHECK(2 * squared == Approx(told).epsilon(0.25));
  CHECK(poses::shared_deviation(points, noise(points.cols(), 3), 0.1F).doubt ==
        Approx(3 * poses::shared_deviation(points, noise(points.cols(), 1), 0.1F).doubt));
}

TEST_CASE("where patches have single points nothing tells what they share", "[poses]") {
  const Eigen::Matrix3Xf points = square();
  CHECK(poses::shared_deviation(points, noise(points.cols(), 1), 0.5F / kSide).deviation == 0);
  CHECK(poses::shared_deviation(points.leftCols(1), noise(1, 1), 0.1F).deviation == 0);
  CHECK(poses::shared_deviation(points.leftCols(0), {}, 0.1F).deviation == 0);
}

}  // namespace posevote::patches_test
