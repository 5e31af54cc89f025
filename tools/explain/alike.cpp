// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/alike.hpp"

#include <algorithm>
#include <numbers>

namespace posevote::explain {
namespace {

constexpr double kNearCentre = 0.1;  // x diagonal: where instances are the same (segment: nms)
constexpr double kNearTurn = std::numbers::pi / 6;
constexpr int kTurns = 24;  // about an axis

}  // namespace

Alike::Alike(const Model& model, const Eigen::Isometry3d& T_scene_model)
    : center_(model.center), diagonal_(static_cast<double>(model.diagonal)) {
  const Symmetries& symmetries = model.symmetries;
  const Eigen::Translation3d to(symmetries.fixed_point.cast<double>());
  const Eigen::Translation3d back(-symmetries.fixed_point.cast<double>());
  for (const Eigen::Quaternionf& turn : symmetries.turns) {
    const Eigen::Quaterniond q = turn.cast<double>().normalized();
    poses_.push_back(T_scene_model * Eigen::Isometry3d(to * q * back));
    for (const Eigen::Vector3f& axis : symmetries.axes)
      for (int i = 1; i < kTurns; ++i) {
        const Eigen::AngleAxisd about(2 * std::numbers::pi * i / kTurns,
                                      axis.cast<double>().normalized());
        poses_.push_back(T_scene_model * Eigen::Isometry3d(to * (q * about) * back));
      }
  }
}

double Alike::distance(const Eigen::Isometry3d& T_scene_model) const {
  const Eigen::Vector3d center = posed_center(T_scene_model, center_);
  double least = (posed_center(poses_.front(), center_) - center).norm();
  for (const Eigen::Isometry3d& pose : poses_)
    least = std::min(least, (posed_center(pose, center_) - center).norm());
  return least;
}

double Alike::turn(const Eigen::Isometry3d& T_scene_model) const {
  const Eigen::Quaterniond q(T_scene_model.linear());
  double least = std::numbers::pi;
  for (const Eigen::Isometry3d& pose : poses_)
    least = std::min(least, q.angularDistance(Eigen::Quaterniond(pose.linear())));
  return least;
}

bool Alike::is_near(const Eigen::Isometry3d& T_scene_model) const {
  return distance(T_scene_model) <= kNearCentre * diagonal_ && turn(T_scene_model) <= kNearTurn;
}

bool Alike::is_near(const Hypothesis& pose) const {
  const double off = (posed_center(poses_.front(), center_) - pose.center.cast<double>()).norm();
  // Where the fixed point is not the centre a turn moves the centre a little.
  return off <= 4 * kNearCentre * diagonal_ && is_near(T_scene_model_of(pose, center_));
}

}  // namespace posevote::explain
