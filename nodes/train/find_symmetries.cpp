// SPDX-License-Identifier: BSD-3-Clause
// Motions that carry a model onto itself, or nearly so. Exact ones are its symmetries: nobody can
// tell the poses apart (a can turned about its axis), so their votes should agree and a robot may
// choose. Near ones tell two poses apart by little: a carton turned by half, a cup upside down. From
// most sides they look alike and get each other's votes, so who finds one should look at the others
// too (poses/twins.hpp).
//
// Rotations about the centre, spread evenly over SO(3) (Alexa, "Super-Fibonacci Spirals", CVPR
// 2022), are rated by the share of points that come to lie near a point whose normal agrees; the
// best are refined by ICP and rated anew, finely. The exact ones of them make a group, or an axis
// (exact_symmetries.hpp). Of each near one it notes the points of the cloud by which the two differ;
// so the cloud must be the one that the model is made of.
// Cost: some 600 000 searches for a neighbour, and two for each motion and point.
//
//   find_symmetries: {in: [cloud, scale], out: [symmetries, near_symmetries], least: 0.6}
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/model.hpp"
#include "nodes/geometry/icp.hpp"
#include "nodes/geometry/rotation.hpp"
#include "nodes/geometry/select_rows.hpp"
#include "nodes/geometry/strewn.hpp"
#include "nodes/train/exact_symmetries.hpp"

namespace posevote::train {
namespace {

using Eigen::Isometry3d;

struct Params {
  double least = 0.6;
  int most = 12;
  int rotations = 1200;
  int refined = 60;
  int sample = 500;
  double coarse = 0.05;
  double fine = 2;
  double round = 0.99;
  double symmetric = 0.999;
  double nearly_round = 0.8;
  double same_motion = 20;
};

struct Rated {
  Isometry3d motion = Isometry3d::Identity();
  double overlap = 0;
};

Eigen::Quaterniond spiral_rotation(std::size_t i, std::size_t count) {
  constexpr double kPhi = std::numbers::sqrt2, kPsi = 1.533751168755204288118041;
  const double s = static_cast<double>(i) + 0.5, turn = 2 * std::numbers::pi * s;
  const double t = s / static_cast<double>(count);
  const double r = std::sqrt(t), R = std::sqrt(1 - t);
  const double alpha = turn / kPhi, beta = turn / kPsi;
  return {R * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha), R * std::sin(beta)};
}

Cloud every(const Cloud& cloud, Eigen::Index count) {
  return geometry::select_rows(cloud, geometry::Strewn(cloud.points.rows(), count).numbers());
}

/// Share of the sample's points of which, moved, `is_on(point)` holds.
template <class IsOn>
double share_of(const Cloud& sample, const Isometry3d& motion, const IsOn& is_on) {
  const Eigen::Isometry3f T = motion.cast<float>();
  int on = 0;
  for (Eigen::Index i = 0; i < sample.points.rows(); ++i)
    on += is_on(geometry::posed_point(sample, i, T));
  return on / static_cast<double>(sample.points.rows());
}

/// Share of the sample that a motion brings near to the surface.
double overlap_of(const Cloud& sample, const geometry::ScanSurface& surface,
                  const Isometry3d& motion, float distance) {
  return share_of(sample, motion, [&](const geometry::OrientedPoint& p) {
    return surface.nearest_compatible(p, distance).has_value();
  });
}

void sort_by_overlap(std::vector<Rated>& motions) {
  std::stable_sort(motions.begin(), motions.end(),
                   [](const Rated& a, const Rated& b) { return a.overlap > b.overlap; });
}

/// The rotations that bring most of the model near to itself.
std::vector<Rated> rate_rotations(const Cloud& cloud, const Eigen::Vector3d& center, float near,
                                  const Params& params) {
  const Cloud sample = every(cloud, params.sample), coarse = every(cloud, 4 * params.sample);
  const geometry::ScanSurface surface(coarse, false, near);
  std::vector<Rated> motions(static_cast<std::size_t>(params.rotations));
  graph::parallel_for(motions.size(), 8, [&](std::size_t i) {
    motions[i].motion = geometry::turn_about(center, spiral_rotation(i, motions.size()));
    motions[i].overlap = overlap_of(sample, surface, motions[i].motion, near);
  });
  sort_by_overlap(motions);
  motions.resize(std::min(motions.size(), static_cast<std::size_t>(params.refined)));
  return motions;
}

class Judge {
 public:
  Judge(const Cloud& cloud, float fine, const Params& params)
      : params_(params),
        sample_(every(cloud, params.sample)),
        many_(every(cloud, kMany)),
        surface_(cloud, false, fine),
        fine_(fine) {}

  Rated rate(const Isometry3d& motion) const {
    return {motion, overlap_of(sample_, surface_, motion, fine_)};
  }
  Rated refine(const Rated& start, float near) const {
    return rate(geometry::icp(sample_, surface_, start.motion, {40, 2 * near, fine_}));
  }
  /// Whether a motion carries the model onto itself. A notch of a hundredth of the surface tells
  /// which way round an integrated circuit lies.
  bool is_exact(const Isometry3d& motion) const {
    return is_about_exact(motion) && share_on(many_, motion) >= params_.symmetric;
  }
  /// But for marks so small that of round bodies the votes agree about the axis all the same.
  bool is_about_exact(const Isometry3d& motion) const {
    return share_on(sample_, motion) >= params_.round;
  }
  /// The points of the cloud that a motion carries off the surface.
  std::vector<std::uint32_t> carried_off(const Cloud& cloud, const Isometry3d& motion) const {
    const Eigen::Isometry3f T = motion.cast<float>();
    std::vector<std::uint32_t> off;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i)
      if (!is_on(geometry::posed_point(cloud, i, T))) off.push_back(static_cast<std::uint32_t>(i));
    return off;
  }

 private:
  static constexpr Eigen::Index kMany = 5000;

  /// Normals aside, which are anyone's at an edge.
  bool is_on(const geometry::OrientedPoint& p) const { return surface_.is_near(p.point, fine_); }
  double share_on(const Cloud& sample, const Isometry3d& motion) const {
    return share_of(sample, motion, [this](const geometry::OrientedPoint& p) { return is_on(p); });
  }

  const Params& params_;
  Cloud sample_, many_;
  geometry::ScanSurface surface_;
  float fine_;
};

Symmetries find_exact(const Cloud& cloud, const Judge& judge, const std::vector<Rated>& motions,
                      const Params& params) {
  std::vector<Isometry3d> all;
  for (const Rated& one : motions) all.push_back(one.motion);
  return exact_symmetries(
      cloud, all, params.same_motion * std::numbers::pi / 180,
      {[&judge](const Isometry3d& motion) { return judge.is_exact(motion); },
       [&judge](const Isometry3d& motion) { return judge.is_about_exact(motion); }});
}

/// Whether two motions lead to poses that look the same.
bool look_same(const Judge& judge, const Isometry3d& a, const Isometry3d& b,
               const Symmetries& symmetries, double same_motion) {
  const Isometry3d between = a.inverse() * b;
  const auto is_turned_less = [&](double angle) {
    return angle < same_motion * std::numbers::pi / 180;
  };
  if (is_turned_less(Eigen::AngleAxisd(between.linear()).angle()) || judge.is_exact(between))
    return true;
  const bool is_about_axis = std::ranges::any_of(symmetries.axes, [&](const Eigen::Vector3f& one) {
    const Eigen::Vector3d axis = one.cast<double>();
    return is_turned_less(geometry::angle_between_axes(axis, between.linear() * axis));
  });
  return is_about_axis && judge.is_about_exact(between);
}

/// A motion by that angle about the axis of another one [rad].
Isometry3d turned_by(double angle, const Isometry3d& like) {
  const Eigen::AngleAxisd turn(angle, Eigen::AngleAxisd(like.linear()).axis());
  return geometry::turn_about(geometry::point_on_axis(like), Eigen::Quaterniond(turn));
}

/// Even turns about the axis of a motion, where most of the body is round about it: but for a handle,
/// which may be hidden wherever it is. None of a body that is not, nor those that are exact: a gear's.
/// `near` [m]: what ICP overcomes.
std::vector<Isometry3d> turns_of_round(const Judge& judge, const Isometry3d& motion, float near,
                                       const Params& params) {
  constexpr double kTurn = 2 * std::numbers::pi;
  if (params.same_motion == 0) return {};
  const Isometry3d half = judge.refine({turned_by(kTurn / 2, motion)}, near).motion;
  if (Eigen::AngleAxisd(half.linear()).angle() < kTurn / 4) return {};  // back where it came from
  const auto count = static_cast<int>(360 / params.same_motion);
  std::vector<Isometry3d> turns;
  for (int i = 1; i < count; ++i) {
    const Isometry3d turn = turned_by(kTurn * i / count, half);
    if (judge.rate(turn).overlap < params.nearly_round) return {};
    if (!judge.is_exact(turn)) turns.push_back(turn);
  }
  return turns;
}

NearSymmetries find_near(const Cloud& cloud, const Judge& judge, const std::vector<Rated>& motions,
                         const Symmetries& symmetries, float near, const Params& params) {
  NearSymmetries found;
  const auto same = [&](const Isometry3d& a, const Isometry3d& b) {
    return look_same(judge, a, b, symmetries, params.same_motion);
  };
  const auto known = [&](const Isometry3d& motion) {
    return same(Isometry3d::Identity(), motion) ||
           std::any_of(found.items.begin(), found.items.end(),
                       [&](const NearSymmetry& other) { return same(other.motion, motion); });
  };
  const auto add = [&](const Isometry3d& motion) {
    found.items.push_back(
        {motion, judge.carried_off(cloud, motion), judge.carried_off(cloud, motion.inverse())});
  };
  auto most = static_cast<std::size_t>(params.most);
  for (const Rated& one : motions) {
    if (one.overlap < params.least || found.items.size() == most) break;
    if (known(one.motion)) continue;
    const std::vector<Isometry3d> turns = turns_of_round(judge, one.motion, near, params);
    std::ranges::for_each(turns, add);
    if (turns.empty()) add(one.motion);
    most += turns.size();
  }
  return found;
}

std::tuple<Symmetries, NearSymmetries> find_symmetries(const Cloud& cloud, const Scale& scale,
                                                       const Params& params) {
  if (cloud.points.rows() == 0 || cloud.normals.rows() != cloud.points.rows()) return {};
  const Eigen::RowVector3f low = cloud.points.colwise().minCoeff();
  const Eigen::RowVector3f high = cloud.points.colwise().maxCoeff();
  const Eigen::Vector3d center = (0.5F * (low + high)).transpose().cast<double>();
  const float near = static_cast<float>(params.coarse) * (high - low).norm();
  std::vector<Rated> motions = rate_rotations(cloud, center, near, params);
  const Judge judge(cloud, static_cast<float>(params.fine) * scale.resolution, params);
  graph::parallel_for(motions.size(), 1,
                      [&](std::size_t i) { motions[i] = judge.refine(motions[i], near); });
  sort_by_overlap(motions);
  const Symmetries exact = find_exact(cloud, judge, motions, params);
  return {exact, find_near(cloud, judge, motions, exact, near, params)};
}

const auto registered =
    graph::register_node(
        "find_symmetries", find_symmetries,
        "Motions that carry a model onto itself, or nearly so, and where the two differ.")
        .input("cloud")
        .input("scale")
        .output("symmetries")
        .output("near_symmetries")
        .param("least", &Params::least, "",
               "Share of the surface that must come to lie on the surface again.",
               graph::in_range(0.1, 1))
        .param("most", &Params::most, "", "Motions to keep; 0: none.", graph::in_range(0, 100))
        .expert_param(
            "rotations", &Params::rotations, "",
            "Rotations that are tried: any is within some 15 deg of one of them, which ICP "
            "overcomes. Training time grows with it.",
            graph::in_range(1, 100000))
        .expert_param("refined", &Params::refined, "",
                      "Of these, refined by ICP. Training time grows with it.",
                      graph::in_range(1, 100000))
        .expert_param("sample", &Params::sample, "points",
                      "That rate a motion. Training time grows with it.",
                      graph::in_range(10, 100000))
        .expert_param("coarse", &Params::coarse, "x diagonal",
                      "A point this near to the surface lies on it, before ICP: what a rotation "
                      "may be off.",
                      graph::in_range(0.001, 1))
        .expert_param("fine", &Params::fine, "x resolution",
                      "And after it: what a scan may show of a difference (inlier_distance).",
                      graph::in_range(0.1, 100))
        .expert_param("round", &Params::round, "",
                      "Share of points that stay on the surface at all turns about an axis from "
                      "which on an object is round.",
                      graph::in_range(0, 1))
        .expert_param(
            "nearly_round", &Params::nearly_round, "",
            "Share of the surface that lies on it at any turn about an axis from which on "
            "these turns are looked at evenly, as of a mug whose handle is hidden.",
            graph::in_range(0, 1))
        .expert_param("symmetric", &Params::symmetric, "",
                      "And at other motions, from which on nothing differs; the rest is sampling.",
                      graph::in_range(0, 1))
        .expert_param("same_motion", &Params::same_motion, "deg",
                      "Motions that differ by less are one.", graph::in_range(0, 180));

}  // namespace
}  // namespace posevote::train
