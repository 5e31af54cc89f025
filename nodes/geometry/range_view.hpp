// SPDX-License-Identifier: BSD-3-Clause
// What the sensor saw in every direction: a coarse range image of the scan from its viewpoint. A
// pose whose points would stand in front of the measured surface contradicts the scan, because the
// sensor saw through them; points behind it are merely hidden.
//
// The image plane is perpendicular to the mean viewing direction. A cell is as wide as the scan's
// point spacing at its median range, and every point covers what its own spacing covers, so
// surfaces have no holes; where points compete the nearest stays, which makes "in front" cautious.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Immutable once built.
class RangeView {
 public:
  /// `resolution`: point spacing of the scan [m].
  RangeView(const Cloud& scan, float resolution);

  /// Whether the cloud is the view from its viewpoint: its normals point there and it spans well
  /// under a half space. A merged or synthetic cloud, or a viewpoint inside it, is not; then there
  /// is no telling what is in front.
  bool usable() const { return width_ > 0; }

  /// Distance from the viewpoint to the nearest surface seen in the direction of `point` [m], or 0
  /// where nothing was measured.
  float measured_range(const Eigen::Vector3f& point) const;

  /// Whether `point` lies beside the sensor's image, where that is known: nobody looked there.
  bool is_outside(const Eigen::Vector3f& point) const;

 private:
  bool find_axis(const Cloud& scan, float resolution);
  void lay_out(const std::vector<Eigen::Vector3f>& image_points, float cell);
  void splat(const Eigen::Vector3f& image_point, float half_width);
  Eigen::Vector3f to_image(const Eigen::Vector3f& point) const;

  Eigen::Vector3f viewpoint_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f R_image_scan_ = Eigen::Matrix3f::Identity();  // image plane at unit distance on z
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  std::size_t cell_at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  Eigen::AlignedBox2f image_;
  float cell_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<float> range_;
};

}  // namespace posevote::geometry
