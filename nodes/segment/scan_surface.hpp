// SPDX-License-Identifier: BSD-3-Clause
// The part of a scan that no detection has explained yet, with what is asked of it again and again:
// the nearest point, and whether a posed model point could have been seen at all.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/prepare/grid.hpp"

namespace posevote {

/// A point with its unit normal.
struct OrientedPoint {
  Eigen::Vector3f point, normal;
};

/// Row `i` of a cloud, moved by T.
OrientedPoint posed_point(const Cloud& cloud, Eigen::Index i, const Eigen::Isometry3f& T);

/// Immutable once built.
class ScanSurface {
 public:
  /// The points of `scan` that are not `explained` (empty: none is) and have a normal. `single_view`:
  /// whether the scan is what one sensor at its viewpoint saw (RangeView::usable); if not, a point
  /// counts as visible whichever way it looks. `cell`: about the distance that is asked for most [m].
  ScanSurface(const Cloud& scan, const std::vector<char>& explained, bool single_view, float cell);

  bool empty() const { return points_.rows() == 0; }
  const Eigen::Vector3f& viewpoint() const { return viewpoint_; }
  /// Whether a surface with this orientation turns its outside to the sensor.
  bool faces_sensor(const OrientedPoint& p) const;
  /// The nearest scan point, at most `distance` away, if its normal agrees with p's within 45 deg.
  std::optional<OrientedPoint> nearest_compatible(const OrientedPoint& p, float distance) const;

 private:
  ScanSurface(const std::vector<Eigen::Index>& rows, const Cloud& scan, bool single_view,
              float cell);

  PointMatrix points_, normals_;
  Eigen::Vector3f viewpoint_;
  bool single_view_;
  PointGrid grid_;
};

}  // namespace posevote
