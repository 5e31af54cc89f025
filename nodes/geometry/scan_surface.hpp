// SPDX-License-Identifier: BSD-3-Clause
// The part of a scan that no detection has explained yet, with what is asked of it again and again:
// the nearest point, and whether a posed model point could have been seen at all.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/facing_kernel.hpp"
#include "nodes/geometry/nearest_index.hpp"

namespace posevote::geometry {

/// A point with its unit normal.
struct OrientedPoint {
  Eigen::Vector3f point, normal;
};

/// Row `i` of a cloud, moved by T.
inline OrientedPoint posed_point(const Cloud& cloud, Eigen::Index i, const Eigen::Isometry3f& T) {
  return {T * Eigen::Vector3f(cloud.points.row(i).transpose()),
          T.linear() * Eigen::Vector3f(cloud.normals.row(i).transpose())};
}

/// Constants of the method; poses/term_params.cpp says where they come from.
struct SurfaceTerms {
  double least_facing_cosine = 0.1;  ///< of what a sensor measures at all
  double least_normal_cosine = 0.7;  ///< between normals that agree: 45 deg
};

/// Reading is safe from many threads.
class ScanSurface {
 public:
  /// The points of `scan`; those without a normal are never found. `single_view`: whether the scan
  /// is what one sensor at its viewpoint saw (RangeView::usable); if not, a point counts as visible
  /// whichever way it looks. `reach`: the distance that is asked for most [m].
  ScanSurface(const Cloud& scan, bool single_view, float reach, const SurfaceTerms& terms = {});

  /// From now on, points with explained[row] are not found either.
  void take_out(const std::vector<char>& explained);

  /// Whether a point was taken out, or had no place or normal from the start.
  bool is_gone(std::size_t row) const { return gone_[row] != 0; }
  const Eigen::Vector3f& viewpoint() const { return viewpoint_; }
  /// The cosine between a surface's normal and the way to the sensor, which is how large it looks
  /// there; 0 where it does not turn its outside to the sensor. 1 where no single sensor is known.
  float facing_cosine(const OrientedPoint& p) const {
    if (!single_view_) return p.normal.squaredNorm() > 0 ? 1 : 0;
    const Eigen::Vector3f way = viewpoint_ - p.point;
    const float along = p.normal.dot(way);
    if (!(along > 0)) return 0;  // half of all points, without a root
    const float cosine = along / way.norm();
    return cosine > facing_cosine_ ? cosine : 0;
  }
  /// The same of many points at a time (facing_points.hpp).
  Posing posing(const Eigen::Isometry3f& T_scene_model) const;
  bool faces_sensor(const OrientedPoint& p) const { return facing_cosine(p) > 0; }
  /// The nearest scan point, at most `distance` away, if its normal agrees with p's.
  std::optional<OrientedPoint> nearest_compatible(const OrientedPoint& p, float distance) const;
  /// Which of the scan's that is.
  std::optional<Eigen::Index> compatible_row(const OrientedPoint& p, float distance) const;
  /// Whether there is any within `distance`, whichever way it looks.
  bool is_near(const Eigen::Vector3f& point, float distance) const {
    return static_cast<bool>(nearest_left(point, distance));
  }

 private:
  /// Which of points_ is nearest, whichever way it looks; if it agrees, for `compatible`.
  NearestPoint nearest_left(const Eigen::Vector3f& point, float distance) const;
  NearestPoint compatible(const OrientedPoint& p, float distance) const;

  std::vector<std::uint32_t> rows_;  // place by place: what is asked for together is read together
  std::vector<OrientedPoint> points_;  // those rows
  std::vector<char> gone_;             // per row of the scan: explained, or never there
  Eigen::Vector3f viewpoint_;
  bool single_view_;
  float facing_cosine_, normal_cosine_;  // least
  float reach_;
  NearestIndex near_, far_;  // for distances up to reach_, and beyond
};

}  // namespace posevote::geometry
