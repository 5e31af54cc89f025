// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/rotation_cells.hpp"

#include <algorithm>
#include <cmath>

namespace posevote::density {
namespace {

/// Monotone from [-1, 1] onto [-1, 1]; near to atan, so that cells are nearly equal in angle.
double warp(double u) { return u * (4 - std::abs(u)) / 3; }

std::uint32_t level(double v) {
  constexpr int kHighest = kLevels - 1;
  return static_cast<std::uint32_t>(
      std::clamp(static_cast<int>((v + 1) * kLevels / 2), 0, kHighest));
}

/// The ball of quaternions around p, as chart k sees it (see rotation_boxes).
class ChartView {
 public:
  ChartView(double p_k, double sine)
      : p_k_(p_k),
        sine_(sine),
        whole_(p_k <= sine + 1e-3),
        inverse_(whole_ ? 0 : 1 / (p_k * p_k - sine * sine)) {}

  /// Lowest and highest level of x_a / x_k over the ball; false if that misses [-1, 1].
  bool level_range(double p_a, std::uint32_t& low, std::uint32_t& high) const {
    // Float rounding moves a vote's own v by less than 1e-6; this is twice that.
    constexpr double kMargin = 2e-6;
    double u_low = -1, u_high = 1;
    if (!whole_) {
      const double root = sine_ * std::sqrt(std::max(0.0, p_a * p_a + p_k_ * p_k_ - sine_ * sine_));
      u_low = (p_a * p_k_ - root) * inverse_;
      u_high = (p_a * p_k_ + root) * inverse_;
      if (u_low > 1 + kMargin || u_high < -1 - kMargin) return false;
    }
    low = level(warp(std::max(u_low, -1.0)) - kMargin);
    high = level(warp(std::min(u_high, 1.0)) + kMargin);
    return true;
  }

 private:
  double p_k_, sine_;
  bool whole_;  ///< the ball may cross x_k = 0
  double inverse_;
};

}  // namespace

RotationBall reach_of(const Kernel& kernel, const VotePoint* votes, std::size_t count) {
  const auto quaternion = [votes](std::size_t i) {
    const VotePoint& v = votes[i];
    return std::array<double, 4>{static_cast<double>(v.qw), static_cast<double>(v.qx),
                                 static_cast<double>(v.qy), static_cast<double>(v.qz)};
  };
  const auto product = [](const std::array<double, 4>& a, const std::array<double, 4>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  };
  RotationBall ball{quaternion(0), 1};
  for (std::size_t i = 1; i < count; ++i) {
    const std::array<double, 4> next = quaternion(i);
    const double sign = product(next, quaternion(0)) < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 4; ++k) ball.center[k] += sign * next[k];
  }
  const double length = std::sqrt(product(ball.center, ball.center));
  for (double& number : ball.center) number /= length;
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<double, 4> q = quaternion(i);
    ball.cosine =
        std::min(ball.cosine, std::abs(product(ball.center, q)) / std::sqrt(product(q, q)));
  }
  // The angles of the votes from the centre and of the kernel add up.
  const auto reach = static_cast<double>(kernel.min_cosine);
  const auto sine = [](double cosine) { return std::sqrt(1 - cosine * cosine); };
  ball.cosine = ball.cosine * reach - sine(ball.cosine) * sine(reach);
  return ball;
}

std::uint32_t finest_rotation_cells(Bandwidth bandwidth) {
  // One of n cells per axis is about 3 / n rad wide; about sigma_R / 1.3 was fastest (3 to 5
  // alike).
  const double cells = 4 / static_cast<double>(bandwidth.sigma_r);
  return static_cast<std::uint32_t>(std::clamp(static_cast<int>(cells), 1, 24));
}

// The quaternions x within the angle alpha of p form a cone. The hyperplane x_a = u x_k touches it
// where |p_a - u p_k| = sin alpha sqrt(1 + u^2); the two solutions u bound x_a / x_k over the cone
// as long as it stays on the side x_k > 0, that is for p_k > sin alpha. Where it does not, the
// whole chart is taken.
RotationBoxes rotation_boxes(const RotationBall& ball) {
  const std::array<double, 4>& q = ball.center;
  const double sine = std::sqrt(std::max(0.0, 1 - ball.cosine * ball.cosine));
  // A quaternion of chart k has x_k >= 1/2 (up to its norm), hence lies within 60 deg of the axis
  // k. A ball of 60 deg or more reaches every chart.
  const double limit = ball.cosine > 0.5 ? 0.5 * ball.cosine - std::sqrt(0.75) * sine - 1e-4 : -2;
  RotationBoxes boxes;
  for (std::uint32_t k = 0; k < kCharts; ++k) {
    RotationBox box{k, {0, 0, 0}, {kLevels - 1, kLevels - 1, kLevels - 1}};
    bool reached = true;
    if (std::abs(q[k]) < -limit) {
      // from q and from -q: all of it
    } else if (std::abs(q[k]) >= limit) {
      const double sign = q[k] < 0 ? -1 : 1;  // q and -q are one rotation
      const ChartView view(sign * q[k], sine);
      for (std::uint32_t i = 0; i < 3 && reached; ++i)
        reached = view.level_range(sign * q[(k + i + 1) % 4], box.low[i], box.high[i]);
    } else {
      reached = false;
    }
    if (reached) boxes.items[boxes.count++] = box;
  }
  return boxes;
}

}  // namespace posevote::density
