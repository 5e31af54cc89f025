// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/measure_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/facing_points.hpp"
#include "nodes/geometry/spread.hpp"
#include "nodes/geometry/strewn.hpp"

namespace posevote::poses {
namespace {

/// A cosine, 70 deg: sensors may miss what they see at a more grazing angle, wherever it is.
constexpr float kGrazing = 0.35F;

/// Of the tolerance, by which a surface may be lower or higher than a pose that fits exactly.
constexpr float kSomeHeight = 0.1F;

enum class Verdict { kAway, kSupported, kContradicted, kMismatched, kUnseen, kHidden, kOutside };

struct Judged {
  Verdict verdict = Verdict::kAway;
  float apparent = 0;  // size
  double residual = 0;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  bool at_bend = false;
};

/// What is beside a supported point.
struct Beside {
  unsigned ends = 0, overhang = 0, gaps = 0, filled = 0, holes = 0, filled_holes = 0;
};

/// What the sensor measured, and which distances count as near and as far [m].
struct Sensed {
  Sensed(const geometry::ScanSurface& of, const geometry::RangeView& seen, float near,
         const FitTerms& terms)
      : scan(of),
        view(seen),
        tolerance(near),
        clear_distance(static_cast<float>(terms.clear_distance) * near),
        goes_on_within(static_cast<float>(terms.goes_on_within) * near) {}

  const geometry::ScanSurface& scan;
  const geometry::RangeView& view;
  float tolerance, clear_distance, goes_on_within;
};

/// Of a point that faces the sensor. `there`: what one is where something was measured at its range.
Judged judge_by_range(const geometry::OrientedPoint& p, float apparent, const Sensed& sensed,
                      Verdict there) {
  const float measured = sensed.view.measured_range(p.point);
  if (measured == 0) {
    if (sensed.view.is_outside(p.point)) return {Verdict::kOutside};
    return {Verdict::kUnseen, apparent < kGrazing ? 0 : apparent};
  }
  const float before = measured - (p.point - sensed.scan.viewpoint()).norm();
  if (before > sensed.clear_distance) return {Verdict::kContradicted, apparent};
  return {before < -sensed.clear_distance ? Verdict::kHidden : there, apparent, 0, p.normal};
}

/// Likewise, by the nearest point.
Judged judge(const geometry::OrientedPoint& p, float apparent, const Sensed& sensed) {
  if (const auto partner = sensed.scan.nearest_compatible(p, sensed.tolerance))
    return {Verdict::kSupported, apparent,
            static_cast<double>((p.point - partner->point).dot(partner->normal)), partner->normal};
  return judge_by_range(p, apparent, sensed, Verdict::kMismatched);
}

/// Whether the sensor sees both faces of a bend beside a model's point.
bool is_at_bend(const Cloud& model, const Outline& outline, Eigen::Index row,
                const Eigen::Isometry3f& T_scene_model, const geometry::ScanSurface& scan) {
  if (outline.bends.empty()) return false;
  const auto other = static_cast<Eigen::Index>(outline.bends[static_cast<std::size_t>(row)]);
  return other != row && scan.faces_sensor(geometry::posed_point(model, other, T_scene_model));
}

/// Of a place where the model's surface is no more: what the scan's does there.
enum class End { kEnds, kGoesOn, kHidden };

/// A posed model that may stand on something.
struct Stander {
  const Outline& outline;
  Eigen::Isometry3f T_model_scene;

  /// Whether the model lies on one side of a surface, and rises on it. Its heights over that err by
  /// `height` [m] at the place, and by the surface's tilt, which is known as well over half the
  /// outline's reach, the more the farther away.
  bool stands_on(const geometry::OrientedPoint& surface, float height) const {
    const Eigen::Vector3f normal = T_model_scene.linear() * surface.normal;
    const Eigen::Matrix3Xf ways = outline.hull.colwise() - T_model_scene * surface.point;
    const Eigen::RowVectorXf heights = normal.transpose() * ways;
    const Eigen::RowVectorXf errors = 2 * height / outline.reach * ways.colwise().norm();
    return (heights + errors).minCoeff() >= -height && (heights - errors).maxCoeff() >= 0;
  }
};

/// What lies clearly behind what was measured there is hidden, whatever the scan has beside it: along
/// a grazing side ranges differ much from one pixel to the next. What is more than `height` [m] lower
/// or higher is another surface: the ground under a plate.
/// What the model stands on does not tell: ahead of a foot's chamfer the ground comes soon.
End look_at_end(const geometry::OrientedPoint& place, const Sensed& sensed, const Stander& model,
                float height) {
  const float measured = sensed.view.measured_range(place.point);
  const float range = (place.point - sensed.scan.viewpoint()).norm();
  if (measured == 0 || measured < range - sensed.clear_distance) return End::kHidden;
  if (const auto partner = sensed.scan.nearest_compatible(place, sensed.goes_on_within))
    if (std::abs((partner->point - place.point).dot(place.normal)) <= height)
      return model.stands_on(*partner, height) ? End::kHidden : End::kGoesOn;
  return End::kEnds;
}

/// What is hidden does not tell.
void count_end(End end, unsigned& told, unsigned& goes_on) {
  told += end != End::kHidden;
  goes_on += end == End::kGoesOn;
}

/// Of a point that takes a side.
void count_side(const Judged& point, double Sides::*side, Sides& sides) {
  const auto apparent = static_cast<double>(point.apparent);
  sides.*side += apparent;
  if (!point.at_bend) return;
  sides.at_bends += apparent;
  if (side == &Sides::mismatched) sides.mismatched_at_bends += apparent;
}

Fit count(const std::vector<Judged>& points) {
  Fit fit;
  double squared = 0;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (const Judged& point : points) {
    if (point.verdict == Verdict::kAway) continue;
    ++fit.facing;
    squared += point.residual * point.residual;
    switch (point.verdict) {
      case Verdict::kAway:
        break;
      case Verdict::kSupported: {
        ++fit.supported;
        count_side(point, &Sides::supported, fit.apparent);
        const Eigen::Vector3d normal = point.normal.cast<double>();
        normals += normal * normal.transpose();
        break;
      }
      case Verdict::kContradicted:
        ++fit.contradicted;
        count_side(point, &Sides::contradicted, fit.apparent);
        break;
      case Verdict::kMismatched:
        ++fit.mismatched;
        count_side(point, &Sides::mismatched, fit.apparent);
        break;
      case Verdict::kUnseen:
        ++fit.unseen;
        count_side(point, &Sides::mismatched, fit.apparent);
        break;
      case Verdict::kOutside:
        ++fit.outside;
        [[fallthrough]];
      case Verdict::kHidden:
        ++fit.hidden;
    }
  }
  if (fit.supported == 0) return fit;
  fit.inlier_fraction = static_cast<double>(fit.supported) / static_cast<double>(fit.facing);
  fit.rmse = std::sqrt(squared / static_cast<double>(fit.supported));
  fit.relief = geometry::relief_of(normals / static_cast<double>(fit.supported));
  return fit;
}

void add(const std::vector<Beside>& points, Fit& fit) {
  for (const Beside& point : points) {
    fit.ends += point.ends;
    fit.overhang += point.overhang;
    fit.gaps += point.gaps;
    fit.filled += point.filled;
    fit.holes += point.holes;
    fit.filled_holes += point.filled_holes;
  }
}

}  // namespace

Fit measure_fit(const Cloud& model, const Outline& outline, const geometry::ScanSurface& scan,
                const geometry::RangeView& view, const Eigen::Isometry3d& T_scene_model,
                float tolerance, const Sampling& sampling, const FitTerms& terms) {
  const Sensed sensed(scan, view, tolerance, terms);
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const geometry::Strewn rows(model.points.rows(), sampling.points);
  std::vector<Judged> points(rows.size());
  const auto judge_one = [&](std::size_t i, const geometry::OrientedPoint& p, float apparent) {
    points[i] = judge(p, apparent, sensed);
    points[i].at_bend = points[i].apparent > 0 && points[i].verdict != Verdict::kHidden &&
                        is_at_bend(model, outline, rows[i], T, scan);
  };
  graph::parallel_ranges(points.size(), 512, [&](std::size_t begin, std::size_t end) {
    geometry::for_each_facing(model, rows, begin, end, T, scan, judge_one);
  });
  Fit fit = count(points);
  fit.stands_for = static_cast<double>(rows.stride());
  const float height = static_cast<float>(terms.same_height * fit.rmse) + kSomeHeight * tolerance;
  const Stander stander{outline, T.inverse()};
  std::vector<Beside> beside(points.size());
  graph::parallel_for(points.size(), 512, [&](std::size_t i) {
    if (points[i].verdict != Verdict::kSupported) return;
    const Eigen::Index row = rows[i];
    const Eigen::Vector3f normal = geometry::posed_point(model, row, T).normal;
    geometry::for_each_end(model, outline, row, [&](const Eigen::Vector3f& end) {
      count_end(look_at_end({T * end, normal}, sensed, stander, height), beside[i].ends,
                beside[i].overhang);
    });
    if (!sampling.closely) return;
    geometry::for_each_gap(model, outline, row, [&](const Eigen::Vector3f& gap, bool is_hole) {
      const End end = look_at_end({T * gap, normal}, sensed, stander, height);
      count_end(end, beside[i].gaps, beside[i].filled);
      if (is_hole) count_end(end, beside[i].holes, beside[i].filled_holes);
    });
  });
  add(beside, fit);
  return fit;
}

Fit measure_by_range(const Cloud& model, const geometry::ScanSurface& scan,
                     const geometry::RangeView& view, const Eigen::Isometry3d& T_scene_model,
                     float tolerance, Eigen::Index points, const FitTerms& terms) {
  const Sensed sensed(scan, view, tolerance, terms);
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const geometry::Strewn rows(model.points.rows(), points);
  std::vector<Judged> judged(rows.size());
  geometry::for_each_facing(model, rows, 0, rows.size(), T, scan,
                            [&](std::size_t k, const geometry::OrientedPoint& p, float apparent) {
                              judged[k] = judge_by_range(p, apparent, sensed, Verdict::kSupported);
                            });
  Fit fit = count(judged);
  fit.stands_for = static_cast<double>(rows.stride());
  return fit;
}

Evidence weigh_points(const Cloud& model, const std::vector<std::uint32_t>& points,
                      const geometry::ScanSurface& scan, const geometry::RangeView& view,
                      const Eigen::Isometry3d& T_scene_model, float tolerance,
                      const FitTerms& terms) {
  const Sensed sensed(scan, view, tolerance, terms);
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  std::vector<Judged> judged;
  judged.reserve(points.size());
  const auto judge_one = [&](std::size_t, const geometry::OrientedPoint& p, float apparent) {
    Judged one = judge(p, apparent, sensed);
    if (one.verdict != Verdict::kSupported && one.apparent < kGrazing) return;
    one.apparent = 1;  // all alike, so that their number tells how sure the balance is
    judged.push_back(one);
  };
  geometry::for_each_facing(model, points, 0, points.size(), T, scan, judge_one);
  const Fit fit = count(judged);
  return {fit.apparent.supported - fit.apparent.against(terms), fit.facing - fit.hidden};
}

double lead_of(const Evidence& one, const Evidence& other) {
  const auto sides = static_cast<double>(one.sides + other.sides);
  return sides > 0 ? (one.balance - other.balance) / std::sqrt(sides) : 0;
}

}  // namespace posevote::poses
