// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::geometry {
namespace {

float squared(float value) { return value * value; }

}  // namespace

OrientedPoint posed_point(const Cloud& cloud, Eigen::Index i, const Eigen::Isometry3f& T) {
  return {T * Eigen::Vector3f(cloud.points.row(i).transpose()),
          T.linear() * Eigen::Vector3f(cloud.normals.row(i).transpose())};
}

ScanSurface::ScanSurface(const Cloud& scan, bool single_view, float reach,
                         const SurfaceTerms& terms)
    : points_(scan.points),
      normals_(scan.normals),
      gone_(static_cast<std::size_t>(scan.points.rows()), 0),
      viewpoint_(scan.view.origin),
      single_view_(single_view),
      facing_squared_(squared(static_cast<float>(terms.least_facing_cosine))),
      normal_cosine_(static_cast<float>(terms.least_normal_cosine)),
      index_(points_, reach) {
  for (std::size_t i = 0; i < gone_.size(); ++i) {
    const bool usable = normals_.row(static_cast<Eigen::Index>(i)).squaredNorm() > 0.5F;
    gone_[i] = static_cast<char>(!usable);
  }
}

void ScanSurface::take_out(const std::vector<char>& explained) {
  for (std::size_t i = 0; i < gone_.size(); ++i)
    gone_[i] = static_cast<char>(gone_[i] | explained[i]);
}

bool ScanSurface::faces_sensor(const OrientedPoint& p) const {
  if (!single_view_) return p.normal.squaredNorm() > 0;
  const Eigen::Vector3f to_sensor = viewpoint_ - p.point;
  const float along = p.normal.dot(to_sensor);
  return along > 0 && along * along > facing_squared_ * to_sensor.squaredNorm();
}

std::optional<Neighbour> ScanSurface::nearest_left(const Eigen::Vector3f& point,
                                                   float distance) const {
  return index_.nearest(point, distance, gone_);
}

std::optional<OrientedPoint> ScanSurface::nearest_compatible(const OrientedPoint& p,
                                                             float distance) const {
  const std::optional<Eigen::Index> row = compatible_row(p, distance);
  if (!row) return std::nullopt;
  return OrientedPoint{points_.row(*row).transpose(), normals_.row(*row).transpose()};
}

std::optional<Eigen::Index> ScanSurface::compatible_row(const OrientedPoint& p,
                                                        float distance) const {
  const std::optional<Neighbour> nearest = nearest_left(p.point, distance);
  if (!nearest) return std::nullopt;
  const auto row = static_cast<Eigen::Index>(nearest->index);
  if (normals_.row(row).transpose().dot(p.normal) < normal_cosine_) return std::nullopt;
  return row;
}

}  // namespace posevote::geometry
