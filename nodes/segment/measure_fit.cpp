// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/measure_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/parallel.hpp"

namespace posevote {
namespace {

constexpr double kConvincing = 0.1;  // inlier fraction x relief: full view 0.3, flat patch 0.002

enum class Verdict { kAway, kSupported, kContradicted, kMismatched, kUnseen, kHidden };

struct Judged {
  Verdict verdict = Verdict::kAway;
  double residual = 0;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

Judged judge(const OrientedPoint& p, const ScanSurface& scan, const RangeView& view,
             const Eigen::Vector3f& viewpoint, float tolerance) {
  if (!scan.faces_sensor(p)) return {};
  if (const std::optional<OrientedPoint> partner = scan.nearest_compatible(p, tolerance))
    return {Verdict::kSupported,
            static_cast<double>((p.point - partner->point).dot(partner->normal)),
            partner->normal};
  const float measured = view.measured_range(p.point);
  if (measured == 0) return {Verdict::kUnseen};
  const float before = measured - (p.point - viewpoint).norm();
  if (before > 2 * tolerance) return {Verdict::kContradicted};
  return {before < -2 * tolerance ? Verdict::kHidden : Verdict::kMismatched};
}

/// 1 - the largest eigenvalue of the mean of n n^T.
double relief_of(const Eigen::Matrix3d& sum_of_squares, std::size_t count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum_of_squares /
                                                              static_cast<double>(count));
  return std::max(0.0, 1 - solver.eigenvalues()[2]);
}

Fit count(const std::vector<Judged>& points) {
  Fit fit;
  double squared = 0;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (const Judged& point : points) {
    if (point.verdict == Verdict::kAway) continue;
    ++fit.facing;
    squared += point.residual * point.residual;
    const Eigen::Vector3d normal = point.normal.cast<double>();
    normals += normal * normal.transpose();
    fit.supported += point.verdict == Verdict::kSupported;
    fit.contradicted += point.verdict == Verdict::kContradicted;
    fit.mismatched += point.verdict == Verdict::kMismatched;
    fit.unseen += point.verdict == Verdict::kUnseen;
    fit.hidden += point.verdict == Verdict::kHidden;
  }
  if (fit.supported == 0) return fit;
  fit.inlier_fraction = static_cast<double>(fit.supported) / static_cast<double>(fit.facing);
  fit.rmse = std::sqrt(squared / static_cast<double>(fit.supported));
  fit.relief = relief_of(normals, fit.supported);
  return fit;
}

}  // namespace

Fit measure_fit(const Cloud& model, const ScanSurface& scan, const RangeView& view,
                const Eigen::Isometry3d& T_scene_model, float tolerance, Eigen::Index samples) {
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const Eigen::Index stride = samples > 0 ? model.points.rows() / samples + 1 : 1;
  std::vector<Judged> points(static_cast<std::size_t>((model.points.rows() + stride - 1) / stride));
  graph::parallel_for(points.size(), 512, [&](std::size_t i) {
    const OrientedPoint p = posed_point(model, static_cast<Eigen::Index>(i) * stride, T);
    points[i] = judge(p, scan, view, scan.viewpoint(), tolerance);
  });
  return count(points);
}

double fit_score(const Fit& fit) {
  if (fit.supported == 0) return 0;
  const auto supported = static_cast<double>(fit.supported);
  const double against = static_cast<double>(fit.contradicted) +
                         0.5 * static_cast<double>(fit.mismatched + fit.unseen);
  const double agreement = supported / (supported + against);
  const double evidence = 1 - std::exp(-fit.inlier_fraction * fit.relief / kConvincing);
  return agreement * evidence;
}

}  // namespace posevote
