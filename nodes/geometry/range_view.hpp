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

/// Constants of the method; poses/term_params.cpp says where they come from.
struct ViewTerms {
  double trusted = 0.9;  ///< share of points that must look like a single view
  double least_mean_cosine =
      0.5;  ///< of the rays to their mean: a view spans well under a half space
  double least_axis_cosine = 0.26;  ///< 75 deg off the axis: a plane image ends here
  double footprint = 0.75;          ///< half-width a point covers, x spacing: neighbours overlap
  int most_cells = 2000;            ///< per side
  int most_half_cells = 8;          ///< a point right before the sensor does not fill the image
};

/// Immutable once built.
class RangeView {
 public:
  /// `resolution`: point spacing of the scan [m].
  RangeView(const Cloud& scan, float resolution, const ViewTerms& terms = {});

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
  bool find_axis(const Cloud& scan, float resolution, const ViewTerms& terms);
  void lay_out(const std::vector<Eigen::Vector3f>& image_points, float cell, int most_cells);
  /// The cells that a point covers: as many on either side of its own.
  struct Patch {
    int u = 0, v = 0, reach = 0;
    float range = 0;
  };
  /// Into rows of cells from the first to the last.
  void splat(const Patch& patch, int first_row, int last_row);
  Eigen::Vector3f to_image(const Eigen::Vector3f& point) const;

  Eigen::Vector3f viewpoint_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f R_image_scan_ = Eigen::Matrix3f::Identity();  // image plane at unit distance on z
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  std::size_t cell_at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  Eigen::AlignedBox2f image_;
  float least_axis_cosine_ = 0;
  float cell_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<float> range_;
};

}  // namespace posevote::geometry
