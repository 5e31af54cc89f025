// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/train/exact_symmetries.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "nodes/geometry/rotation.hpp"

namespace posevote::train {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kMostTurns = 60;  ///< of the icosahedron; finer ones are continuous
constexpr double kOneAxis = 20 * kDegree;

class Finder {
 public:
  Finder(const Cloud& cloud, double same, const IsExact& is_exact)
      : same_(same), is_exact_(is_exact), mean_(cloud.points.cast<double>().colwise().mean()) {
    const Eigen::MatrixX3d offsets = cloud.points.cast<double>().rowwise() - mean_.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(offsets.transpose() * offsets);
    for (int i = 0; i < 3; ++i) main_axes_.emplace_back(solver.eigenvectors().col(i));
  }

  const Vector3d& mean() const { return mean_; }
  bool is_exact(const Quaterniond& turn) const {
    return is_exact_.strictly(geometry::turn_about(mean_, turn));
  }

  /// Continuous ones: main axes of the cloud, which are the most precise, or of the turns; at most
  /// two.
  std::vector<Vector3d> axes(const std::vector<Quaterniond>& turns) const {
    std::vector<Vector3d> candidates = main_axes_, found;
    for (const Quaterniond& turn : turns)
      if (AngleAxisd(turn).angle() > same_) candidates.push_back(AngleAxisd(turn).axis());
    for (const Vector3d& axis : candidates) {
      const bool known = std::any_of(found.begin(), found.end(), [&](const Vector3d& other) {
        return std::abs(axis.dot(other)) > std::cos(kOneAxis);
      });
      if (known || !is_continuous(axis)) continue;
      found.push_back(axis);
      if (found.size() == 2) break;
    }
    return found;
  }

  /// Half a turn that exchanges the ends of an axis, if there is one.
  std::vector<Quaterniond> flips(const Vector3d& axis) const {
    const Quaterniond flip(AngleAxisd(std::numbers::pi, axis.unitOrthogonal()));
    if (is_exact(flip)) return {flip};
    return {};
  }

  /// The turns and what they make one after the other.
  std::vector<Quaterniond> closed(const std::vector<Quaterniond>& turns) const {
    std::vector<Quaterniond> all{Quaterniond::Identity()};
    for (const Quaterniond& turn : turns) add(turn, all);
    for (std::size_t a = 1; a < all.size(); ++a)
      for (std::size_t b = 1; b <= a; ++b) {
        add(all[a] * all[b], all);
        add(all[b] * all[a], all);
      }
    return all;
  }

 private:
  bool is_continuous(const Vector3d& axis) const {
    for (const double degrees : {23.0, 49.0, 67.0, 83.0, 101.0, 131.0, 157.0})
      if (!is_exact_.about(
              geometry::turn_about(mean_, Quaterniond(AngleAxisd(degrees * kDegree, axis)))))
        return false;
    return true;
  }
  void add(const Quaterniond& turn, std::vector<Quaterniond>& all) const {
    const bool known = std::any_of(all.begin(), all.end(), [&](const Quaterniond& other) {
      return turn.angularDistance(other) < same_;
    });
    if (!known && all.size() < kMostTurns && is_exact(turn)) all.push_back(turn.normalized());
  }

  double same_;
  const IsExact& is_exact_;
  Vector3d mean_;
  std::vector<Vector3d> main_axes_;
};

}  // namespace

Symmetries exact_symmetries(const Cloud& cloud, const std::vector<Eigen::Isometry3d>& motions,
                            double same, const IsExact& is_exact) {
  const Finder finder(cloud, same, is_exact);
  std::vector<Quaterniond> turns;
  for (const Eigen::Isometry3d& motion : motions) {
    const Quaterniond turn(motion.linear());
    if (finder.is_exact(turn)) turns.push_back(turn);
  }
  Symmetries found;
  found.fixed_point = finder.mean().cast<float>();
  const std::vector<Vector3d> axes = finder.axes(turns);
  for (const Vector3d& axis : axes) found.axes.push_back(axis.cast<float>());
  if (axes.size() == 1) turns = finder.flips(axes[0]);
  if (axes.size() > 1) turns.clear();
  const std::vector<Quaterniond> all = finder.closed(turns);
  for (std::size_t i = 1; i < all.size(); ++i) found.turns.push_back(all[i].cast<float>());
  return found;
}

}  // namespace posevote::train
