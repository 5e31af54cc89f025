// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/painted_symmetry.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace posevote {
namespace {

/// Of its vertices at most a hundredth, as at the border of two fields, may look otherwise.
bool looks_alike(const Mesh& mesh, const Paint& paint, const Eigen::Matrix3d& turn,
                 const Eigen::Vector3d& center) {
  constexpr float kSameColor = 0.02F;
  Eigen::Index others = 0;
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    const Eigen::Vector3d place = mesh.points.row(i).transpose().cast<double>();
    const Eigen::Vector3f before = paint.at(place),
                          after = paint.at(center + turn * (place - center));
    others += (before - after).cwiseAbs().maxCoeff() > kSameColor;
  }
  return 100 * others <= mesh.points.rows();
}

}  // namespace

ShapeSymmetry painted_symmetry(const ShapeSymmetry& shape, const Mesh& mesh, const Paint& paint) {
  const auto is_round_about = [&](const Eigen::Vector3d& axis) {
    constexpr std::array kTurns{0.1, 0.23, 0.37, 0.5, 0.71};  // no paint repeats itself after all
    return std::all_of(kTurns.begin(), kTurns.end(), [&](double turns) {
      const Eigen::AngleAxisd turn(2 * std::numbers::pi * turns, axis);
      return looks_alike(mesh, paint, turn.toRotationMatrix(), shape.center);
    });
  };
  ShapeSymmetry left = shape;
  left.is_round = shape.is_round && is_round_about(Eigen::Vector3d::UnitZ());
  std::erase_if(left.axes, [&](const auto& axis) { return !is_round_about(axis); });
  std::erase_if(left.turns,
                [&](const auto& turn) { return !looks_alike(mesh, paint, turn, shape.center); });
  return left;
}

}  // namespace posevote
