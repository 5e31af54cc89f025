// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/color_turns.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "nodes/geometry/rotation.hpp"

namespace posevote::poses {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// One pose that was tried.
struct Tried {
  Eigen::Isometry3d T_scene_model;
  std::optional<ColorFit> colors;
};

class Turner {
 public:
  Turner(const Sought& sought, const Symmetries& symmetries, const Candidate& candidate)
      : sought_(sought), symmetries_(symmetries), origin_(candidate.T_scene_model) {}

  Tried with(const Eigen::Quaterniond& turn, Eigen::Index points) const {
    const Eigen::Isometry3d T =
        origin_ * geometry::turn_about(symmetries_.fixed_point.cast<double>(), turn.normalized());
    return {T, measure_colors(sought_, T, points)};
  }
  /// In [-1, 1]; less where nothing can be compared.
  double likeness(const Eigen::Quaterniond& turn, Eigen::Index points) const {
    const std::optional<ColorFit> colors = with(turn, points).colors;
    return colors ? colors->likeness : -2;
  }
  /// Of all turns, and of their steps about an axis, the one that agrees best.
  Eigen::Quaterniond best() const {
    const ColorTerms& terms = sought_.terms.color;
    const double step = terms.step * std::numbers::pi / 180;
    const int steps = symmetries_.axes.size() == 1 ? static_cast<int>(std::ceil(kTurn / step)) : 1;
    Eigen::Quaterniond best = Eigen::Quaterniond::Identity();
    double highest = likeness(best, terms.glance_points);
    const auto consider = [&](const Eigen::Quaterniond& turn, Eigen::Index points) {
      const double tried = likeness(turn, points);
      if (tried <= highest) return;
      best = turn;
      highest = tried;
    };
    for (const Eigen::Quaternionf& turn : symmetries_.turns)
      for (int i = 0; i < steps; ++i)
        consider(turn.cast<double>() * about_axis(kTurn * i / steps), terms.glance_points);
    if (steps == 1) return best;
    highest = likeness(best, terms.look_points);
    for (double angle = kTurn / steps / 2; angle > step / 8; angle /= 2) {
      const Eigen::Quaterniond middle = best;
      for (const double way : {-angle, angle})
        consider(middle * about_axis(way), terms.look_points);
    }
    return best;
  }

 private:
  Eigen::Quaterniond about_axis(double angle) const {
    if (symmetries_.axes.size() != 1) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, symmetries_.axes[0].cast<double>()));
  }

  const Sought& sought_;
  const Symmetries& symmetries_;
  const Eigen::Isometry3d origin_;
};

}  // namespace

void turn_by_color(const Sought& sought, Candidate& candidate) {
  const ColorTerms& terms = sought.terms.color;
  candidate.colors = measure_colors(sought, candidate.T_scene_model, terms.look_points);
  if (!candidate.colors || !sought.model.shape_symmetries.any()) return;
  const Turner turner(sought, sought.model.shape_symmetries, candidate);
  Tried best = turner.with(turner.best(), terms.look_points);
  if (color_lead(best.colors, candidate.colors) <= 0) return;  // shape says nothing of it
  candidate.T_scene_model = best.T_scene_model;
  candidate.colors = std::move(best.colors);
}

Symmetries symmetries_left(const Sought& sought, const Candidate& candidate) {
  const Symmetries& all = sought.model.symmetries;
  if (!candidate.colors || !all.any()) return all;
  const Turner turner(sought, all, candidate);
  const auto is_as_good = [&](const Eigen::Quaterniond& turn) {
    const Tried turned = turner.with(turn, sought.terms.color.look_points);
    return turned.colors &&
           color_lead(candidate.colors, turned.colors) < sought.terms.twins.telling;
  };
  Symmetries left{all.fixed_point, {all.turns[0]}, {}};
  for (std::size_t i = 1; i < all.turns.size(); ++i)
    if (is_as_good(all.turns[i].cast<double>())) left.turns.push_back(all.turns[i]);
  for (const Eigen::Vector3f& axis : all.axes) {
    bool holds = true;
    for (const double share : {0.125, 0.25, 0.5, 0.75, 0.875})
      holds = holds &&
              is_as_good(Eigen::Quaterniond(Eigen::AngleAxisd(kTurn * share, axis.cast<double>())));
    if (holds) left.axes.push_back(axis);
  }
  return left;
}

}  // namespace posevote::poses
