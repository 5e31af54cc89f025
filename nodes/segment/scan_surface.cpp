// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/scan_surface.hpp"

namespace posevote {
namespace {

constexpr float kMinFacingCosine = 0.1F;  // sensors measure grazing surfaces badly or not at all
constexpr float kMinNormalCosine = 0.7F;  // 45 deg

std::vector<Eigen::Index> left_over(const Cloud& scan, const std::vector<char>& explained) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const bool usable = scan.points.row(i).allFinite() && scan.normals.row(i).squaredNorm() > 0.5F;
    if (usable && (explained.empty() || !explained[static_cast<std::size_t>(i)])) rows.push_back(i);
  }
  return rows;
}

}  // namespace

OrientedPoint posed_point(const Cloud& cloud, Eigen::Index i, const Eigen::Isometry3f& T) {
  return {T * Eigen::Vector3f(cloud.points.row(i).transpose()),
          T.linear() * Eigen::Vector3f(cloud.normals.row(i).transpose())};
}

ScanSurface::ScanSurface(const Cloud& scan, const std::vector<char>& explained, bool single_view,
                         float cell)
    : ScanSurface(left_over(scan, explained), scan, single_view, cell) {}

ScanSurface::ScanSurface(const std::vector<Eigen::Index>& rows, const Cloud& scan,
                         bool single_view, float cell)
    : points_(scan.points(rows, Eigen::all)),
      normals_(scan.normals(rows, Eigen::all)),
      viewpoint_(scan.viewpoint),
      single_view_(single_view),
      grid_(points_, cell) {}

bool ScanSurface::faces_sensor(const OrientedPoint& p) const {
  if (!single_view_) return p.normal.squaredNorm() > 0;
  const Eigen::Vector3f to_sensor = viewpoint_ - p.point;
  return p.normal.dot(to_sensor) > kMinFacingCosine * to_sensor.norm();
}

std::optional<OrientedPoint> ScanSurface::nearest_compatible(const OrientedPoint& p,
                                                             float distance) const {
  const std::optional<Neighbour> nearest = grid_.nearest(p.point, distance);
  if (!nearest) return std::nullopt;
  const auto row = static_cast<Eigen::Index>(nearest->index);
  const Eigen::Vector3f normal = normals_.row(row).transpose();
  if (normal.dot(p.normal) < kMinNormalCosine) return std::nullopt;
  return OrientedPoint{points_.row(row).transpose(), normal};
}

}  // namespace posevote
