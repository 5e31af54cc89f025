// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/range_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::geometry {
namespace {

/// Directions with range in z: (x / z, y / z, range); range 0 for what is not in the image.
Eigen::Vector3f project(const Eigen::Vector3f& in_image_frame, float least_cosine) {
  const float range = in_image_frame.norm();
  if (!(in_image_frame.z() > least_cosine * range)) return Eigen::Vector3f::Zero();
  return {in_image_frame.x() / in_image_frame.z(), in_image_frame.y() / in_image_frame.z(), range};
}

float median_range(const std::vector<Eigen::Vector3f>& image_points) {
  std::vector<float> ranges;
  ranges.reserve(image_points.size());
  for (const Eigen::Vector3f& p : image_points) ranges.push_back(p.z());
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  return *middle;
}

}  // namespace

RangeView::RangeView(const Cloud& scan, float resolution, const ViewTerms& terms)
    : viewpoint_(scan.view.origin),
      image_(scan.view.image),
      least_axis_cosine_(static_cast<float>(terms.least_axis_cosine)) {
  if (!(resolution > 0) || !find_axis(scan, resolution, terms)) return;
  const auto count = static_cast<std::size_t>(scan.points.rows());
  const auto image_points = joined_ranges(count, [&](std::size_t begin, std::size_t end) {
    std::vector<Eigen::Vector3f> in_image;
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Eigen::Vector3f p = to_image(scan.points.row(row).transpose());
      if (p.z() > resolution) in_image.push_back(p);
    }
    return in_image;
  });
  const auto expected = static_cast<float>(terms.trusted) * static_cast<float>(scan.points.rows());
  if (static_cast<float>(image_points.size()) < expected) return;
  lay_out(image_points, resolution / median_range(image_points), terms.most_cells);
  const float half_width = static_cast<float>(terms.footprint) * resolution;
  std::vector<Patch> patches(image_points.size());
  graph::parallel_for(patches.size(), 8192, [&](std::size_t i) {
    const Eigen::Vector3f& p = image_points[i];
    const int reach = static_cast<int>(std::lround(half_width / p.z() / cell_));
    patches[i] = {static_cast<int>((p.x() - origin_.x()) / cell_),
                  static_cast<int>((p.y() - origin_.y()) / cell_),
                  std::min(terms.most_half_cells, reach), p.z()};
  });
  // In bands, side by side; each cell takes the nearest of all.
  constexpr int kBands = 8;
  graph::parallel_for(kBands, 1, [&](std::size_t band) {
    const auto row = [&](std::size_t b) { return static_cast<int>(b) * height_ / kBands; };
    for (const Patch& patch : patches) splat(patch, row(band), row(band + 1) - 1);
  });
}

bool RangeView::find_axis(const Cloud& scan, float resolution, const ViewTerms& terms) {
  const Eigen::Index count = scan.points.rows();
  if (count == 0 || scan.normals.rows() != count) return false;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  Eigen::Index facing = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3f ray = scan.points.row(i).transpose() - viewpoint_;
    const float range = ray.norm();
    if (!(range > resolution) || !std::isfinite(range)) continue;
    axis += (ray / range).cast<double>();
    if (scan.normals.row(i).dot(ray.transpose()) <= 0) ++facing;
  }
  if (static_cast<float>(facing) < static_cast<float>(terms.trusted) * static_cast<float>(count))
    return false;
  if (axis.norm() < terms.least_mean_cosine * static_cast<double>(count)) return false;
  const Eigen::Vector3f z = axis.normalized().cast<float>();
  R_image_scan_ =
      Eigen::Quaternionf::FromTwoVectors(z, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  return true;
}

Eigen::Vector3f RangeView::to_image(const Eigen::Vector3f& point) const {
  return project(R_image_scan_ * (point - viewpoint_), least_axis_cosine_);
}

void RangeView::lay_out(const std::vector<Eigen::Vector3f>& image_points, float cell,
                        int most_cells) {
  Eigen::Vector2f low = image_points.front().head<2>(), high = low;
  for (const Eigen::Vector3f& p : image_points) {
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  }
  cell_ = std::max(cell, (high - low).maxCoeff() / static_cast<float>(most_cells));
  origin_ = low;
  width_ = static_cast<int>((high.x() - low.x()) / cell_) + 1;
  height_ = static_cast<int>((high.y() - low.y()) / cell_) + 1;
  range_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0F);
}

void RangeView::splat(const Patch& patch, int first_row, int last_row) {
  const auto [u, v, reach, nearest] = patch;
  for (int y = std::max(first_row, v - reach); y <= std::min(last_row, v + reach); ++y)
    for (int x = std::max(0, u - reach); x <= std::min(width_ - 1, u + reach); ++x) {
      float& range = range_[cell_at(x, y)];
      if (range == 0 || nearest < range) range = nearest;
    }
}

bool RangeView::is_outside(const Eigen::Vector3f& point) const {
  if (image_.isEmpty()) return false;
  const Eigen::Vector3f ray = point - viewpoint_;
  return !(ray.z() > 0) || !image_.contains(ray.head<2>() / ray.z());
}

float RangeView::measured_range(const Eigen::Vector3f& point) const {
  if (!usable()) return 0;
  const Eigen::Vector3f p = to_image(point);
  if (p.z() == 0) return 0;
  const Eigen::Vector2f cell = (p.head<2>() - origin_) / cell_;
  if (!(cell.minCoeff() >= 0) || !(cell.x() < static_cast<float>(width_)) ||
      !(cell.y() < static_cast<float>(height_)))
    return 0;
  return range_[cell_at(static_cast<int>(cell.x()), static_cast<int>(cell.y()))];
}

}  // namespace posevote::geometry
