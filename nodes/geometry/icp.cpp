// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/icp.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace posevote::geometry {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Where the step turns about, and the lever that makes radians and metres alike.
struct Pivot {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double lever = 0;
};

Pivot find_pivot(const std::vector<IcpPair>& pairs) {
  Pivot pivot;
  double weight = 0;
  for (const IcpPair& pair : pairs) {
    pivot.center += pair.weight * pair.point;
    weight += pair.weight;
  }
  pivot.center /= weight;
  double squared = 0;
  for (const IcpPair& pair : pairs)
    squared += pair.weight * (pair.point - pivot.center).squaredNorm();
  pivot.lever = std::sqrt(squared / weight);
  return pivot;
}

/// (lever x turn, shift) that brings the points closer to the planes.
Vector6d solve_step(const std::vector<IcpPair>& pairs, const Pivot& pivot, double damping) {
  Matrix6d normal_matrix = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double weight = 0;
  for (const IcpPair& pair : pairs) {
    Vector6d row;
    row << (pair.point - pivot.center).cross(pair.normal) / pivot.lever, pair.normal;
    normal_matrix += pair.weight * row * row.transpose();
    gradient += pair.weight * pair.residual * row;
    weight += pair.weight;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(normal_matrix / weight);
  Vector6d step = Vector6d::Zero();
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double held = solver.eigenvalues()[k];
    const Vector6d direction = solver.eigenvectors().col(k);
    if (held + damping > 0) step -= direction.dot(gradient) / weight / (held + damping) * direction;
  }
  return step;
}

/// Shortens a step that leaves the range in which it was linearised.
Vector6d limit_step(const Vector6d& step, double distance) {
  return step / std::max({1.0, step.head<3>().norm() / distance, step.tail<3>().norm() / distance});
}

void move(Eigen::Isometry3d& T_scene_model, const Vector6d& step, const Pivot& pivot) {
  const Eigen::Vector3d turn = step.head<3>() / pivot.lever;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (turn.norm() > 0) R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  const Eigen::Vector3d t = T_scene_model.translation();
  T_scene_model.translation() = R * (t - pivot.center) + pivot.center + step.tail<3>();
  const Eigen::Quaterniond rotation(R * T_scene_model.linear());
  T_scene_model.linear() = rotation.normalized().toRotationMatrix();
}

/// Steps become shorter as a pose settles. Partners that come and go in turn may keep them at one
/// length for good, to and fro.
class Progress {
 public:
  explicit Progress(bool follows_drift) : follows_drift_(follows_drift) {}

  /// Whether one of the last few steps was clearly shorter than all before, or they lead somewhere.
  bool goes_on(const Vector6d& step) {
    constexpr double kShorter = 0.8;
    constexpr double kStraight = 0.8;  // of the way, how far they get
    const double length = step.norm();
    last_[count_++ % kPatience] = step;
    waited_ = length < kShorter * shortest_ ? 0 : waited_ + 1;
    if (waited_ == 0) shortest_ = length;
    if (waited_ < kPatience) return true;
    if (!follows_drift_) return false;
    Vector6d gone = Vector6d::Zero();
    double way = 0;
    for (const Vector6d& one : last_) {
      gone += one;
      way += one.norm();
    }
    return gone.norm() > kStraight * way;
  }

 private:
  static constexpr std::size_t kPatience = 5;
  bool follows_drift_;
  std::array<Vector6d, kPatience> last_;
  std::size_t count_ = 0, waited_ = 0;
  double shortest_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Eigen::Isometry3d icp(const Cloud& model, const ScanSurface& scan, const Eigen::Isometry3d& start,
                      const IcpParams& params,
                      const std::function<void(const Eigen::Isometry3d&)>& pass,
                      const MorePairs& more) {
  const IcpTerms& terms = params.terms;
  Eigen::Isometry3d T_scene_model = start;
  const auto end = static_cast<double>(params.end_distance);
  double distance = std::max(end, static_cast<double>(params.start_distance));
  Progress progress(params.follows_drift);
  for (int iteration = 0; iteration < params.iterations; ++iteration) {
    std::vector<IcpPair> pairs = find_icp_pairs(model, scan, T_scene_model.cast<float>(),
                                                static_cast<float>(distance), params.samples);
    if (pairs.size() < static_cast<std::size_t>(terms.fewest_pairs)) break;
    if (more)
      for (const IcpPair& pair : more(T_scene_model, variance_of(pairs))) pairs.push_back(pair);
    const Pivot pivot = find_pivot(pairs);
    if (!(pivot.lever > 0)) break;
    const double damping = distance > end ? terms.damping : terms.final_damping;
    const Vector6d step = limit_step(solve_step(pairs, pivot, damping), distance);
    if (!step.allFinite()) break;
    move(T_scene_model, step, pivot);
    if (pass) pass(T_scene_model);
    if (distance <= end && (step.norm() <= params.still * end || !progress.goes_on(step))) break;
    distance = std::max(end, distance * terms.shrink);
  }
  return T_scene_model;
}

}  // namespace posevote::geometry
