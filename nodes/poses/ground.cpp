// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/ground.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/plane_fit.hpp"
#include "nodes/geometry/scan_surface.hpp"
#include "nodes/geometry/spread.hpp"
#include "nodes/geometry/strewn.hpp"

namespace posevote::poses {
namespace {

using Plane = Eigen::Hyperplane<float, 3>;

constexpr std::size_t kTrials = 100;     // find what is on one point of 20 in 99 of 100 scans
constexpr std::size_t kLeastShare = 20;  // one point of so many
constexpr float kAlike = 0.9F;           // cosine, of normals
constexpr float kRough = 3;              // x depth; a plane by one point's normal is off by that
constexpr Eigen::Index kSample = 1000;   // points of a model
constexpr float kSteep = 0.5F;           // sine to the plane, of what goes into it
constexpr float kBeside = 3;   // x depth; so far beside the model the ground is looked for
constexpr float kSeen = 0.2F;  // of these places, at least
constexpr float kGone = 0.2F;  // of what is in it, beyond which the sensor saw through

/// The points of the scan on a plane.
std::vector<std::size_t> points_on(const Plane& plane, const Cloud& scan,
                                   const std::vector<std::size_t>& sample, float distance) {
  std::vector<std::size_t> on;
  for (const std::size_t i : sample) {
    const auto row = static_cast<Eigen::Index>(i);
    if (plane.absDistance(scan.points.row(row).transpose()) <= distance &&
        plane.normal().dot(scan.normals.row(row)) > kAlike)
      on.push_back(i);
  }
  return on;
}

Plane plane_at(const Cloud& scan, std::size_t i) {
  const auto row = static_cast<Eigen::Index>(i);
  return {scan.normals.row(row).transpose(), scan.points.row(row).transpose()};
}

/// The plane of least squares; its normal on the side of that of `like`.
Ground::Extent fit_plane(const Cloud& scan, const std::vector<std::size_t>& rows,
                         const Plane& like) {
  const auto [mean, covariance] = geometry::moments_of(scan.points, rows);
  const auto radius = static_cast<float>(std::sqrt(covariance.trace()));
  Eigen::Vector3f up = geometry::spread_of(covariance).across.normalized().cast<float>();
  if (up.isZero()) return {like, radius};
  if (up.dot(like.normal()) < 0) up = -up;
  return {Plane(up, Eigen::Vector3f(mean.cast<float>())), radius};
}

std::optional<Ground::Extent> largest_plane(const Cloud& scan, float depth) {
  const std::vector<std::size_t> sample =
      geometry::sample_of(static_cast<std::size_t>(scan.points.rows()));
  if (sample.empty()) return std::nullopt;
  const auto trial = [&](std::size_t i) {
    return plane_at(scan, sample[i * sample.size() / kTrials]);
  };
  std::vector<std::size_t> counts(kTrials);
  graph::parallel_for(kTrials, 1, [&](std::size_t i) {
    counts[i] = points_on(trial(i), scan, sample, kRough * depth).size();
  });
  const auto first = std::ranges::max_element(counts);
  Plane best = trial(static_cast<std::size_t>(first - counts.begin()));
  const std::vector<std::size_t> most = points_on(best, scan, sample, kRough * depth);
  if (most.size() * kLeastShare < sample.size() || most.size() < 3) return std::nullopt;
  best = fit_plane(scan, most, best).plane;
  const std::vector<std::size_t> close = points_on(best, scan, sample, depth);
  if (close.size() < 3) return std::nullopt;
  return fit_plane(scan, close, best);
}

}  // namespace

Ground::Ground(const Cloud& scan, float depth)
    : depth_(depth), viewpoint_(scan.view.origin), extent_(largest_plane(scan, depth)) {}

std::optional<float> Ground::lowest_of(const Model& model,
                                       const Eigen::Isometry3f& T_scene_model) const {
  if (!extent_ || extent_->radius <= model.diagonal / 2) return std::nullopt;
  const Plane& plane = extent_->plane;
  const Eigen::RowVectorXf heights =
      (plane.normal().transpose() * T_scene_model.linear() * model.outline.hull).array() +
      plane.signedDistance(T_scene_model.translation());
  if (heights.maxCoeff() <= depth_) return std::nullopt;
  return heights.minCoeff();
}

std::optional<float> Ground::depth_below(const Model& model,
                                         const Eigen::Isometry3d& T_scene_model) const {
  const std::optional<float> lowest = lowest_of(model, T_scene_model.cast<float>());
  if (!lowest || *lowest > depth_) return std::nullopt;
  return std::max(0.0F, -*lowest / depth_ - 1);
}

double Ground::lead_over(const Model& model, const Eigen::Isometry3d& one,
                         const Eigen::Isometry3d& other) const {
  const std::optional<float> of_one = depth_below(model, one), of_other = depth_below(model, other);
  if (!of_one || !of_other || std::min(*of_one, *of_other) > 0) return 0;
  return static_cast<double>(*of_other - *of_one);
}

double Ground::share_inside(const Model& model, const Eigen::Isometry3d& T_scene_model,
                            const geometry::RangeView& view) const {
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const std::optional<float> lowest = lowest_of(model, T);
  if (!lowest || *lowest >= -depth_) return 0;
  const Plane& plane = extent_->plane;
  const Eigen::RowVector3f up = plane.normal().transpose() * T.linear();
  const float height = plane.signedDistance(T.translation());
  const geometry::Strewn rows(model.cloud.points.rows(), kSample);
  double inside = 0;
  Sights in_it;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::Vector3f point = model.cloud.points.row(rows[k]).transpose();
    if (up.dot(point) + height >= -depth_) continue;
    ++inside;
    look(T * point, view, in_it);
  }
  if (in_it.gone > kGone * (in_it.gone + in_it.seen)) return 0;
  return inside > 0 && is_seen_around(plane, model.cloud, T, view)
             ? inside / static_cast<double>(rows.size())
             : 0;
}

void Ground::look(const Eigen::Vector3f& place, const geometry::RangeView& view,
                  Sights& sights) const {
  const float measured = view.measured_range(place);
  if (measured == 0) return;
  const Eigen::Vector3f ray = (place - viewpoint_).normalized();
  const float height = extent_->plane.signedDistance(viewpoint_ + measured * ray);
  sights.seen += std::abs(height) <= depth_;
  sights.gone += height < -depth_;
}

bool Ground::is_seen_around(const Plane& plane, const Cloud& model,
                            const Eigen::Isometry3f& T_scene_model,
                            const geometry::RangeView& view) const {
  float places = 0;
  Sights beside;
  const geometry::Strewn rows(model.points.rows(), kSample);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto [point, normal] = geometry::posed_point(model, rows[k], T_scene_model);
    if (plane.absDistance(point) > depth_) continue;
    const Eigen::Vector3f side = normal - normal.dot(plane.normal()) * plane.normal();
    if (side.norm() < kSteep) continue;
    ++places;
    look(plane.projection(point) + kBeside * depth_ * side.normalized(), view, beside);
  }
  return beside.seen > beside.gone && beside.seen >= kSeen * places;
}

}  // namespace posevote::poses
