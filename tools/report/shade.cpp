// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/normals.hpp"
#include "tools/report/pack.hpp"

namespace posevote::page {
namespace {

/// Across the plane that fits the points best; 0 where there is none.
Eigen::Vector3f across(const std::vector<Eigen::Vector3f>& points) {
  if (points.size() < 4) return Eigen::Vector3f::Zero();
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& point : points) mean += point;
  mean /= static_cast<float>(points.size());
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (const Eigen::Vector3f& point : points) spread += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(spread);
  return axes.eigenvectors().col(0);
}

PointMatrix plane_normals(const PointMatrix& points, float spacing) {
  const float reach = 2.5F * spacing;
  const geometry::PointGrid grid(points, reach);
  PointMatrix normals(points.rows(), 3);
  std::vector<Eigen::Vector3f> near;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    near.clear();
    grid.for_each_within(points.row(i).transpose(), reach,
                         [&](std::uint32_t j, float) { near.push_back(points.row(j)); });
    normals.row(i) = across(near).transpose();
  }
  return normals;
}

PointMatrix normals_of(const Scan& scan, const PointMatrix& points, const Thinned& thinned) {
  const bool has_normals = scan.normals.rows() == scan.points.rows();
  if (!has_normals && scan.faces.rows() == 0) return plane_normals(points, thinned.spacing);
  const PointMatrix all =
      has_normals ? scan.normals : geometry::face_normals(scan.points, scan.faces);
  PointMatrix normals(points.rows(), 3);
  for (std::size_t i = 0; i < thinned.rows.size(); ++i)
    normals.row(static_cast<Eigen::Index>(i)) = all.row(thinned.rows[i]);
  return normals;
}

}  // namespace

std::vector<std::uint8_t> shade(const Scan& scan, const Thinned& thinned,
                                const Eigen::Vector3f& light) {
  PointMatrix points(std::ssize(thinned.rows), 3);
  for (std::size_t i = 0; i < thinned.rows.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = scan.points.row(thinned.rows[i]);
  PointMatrix normals = normals_of(scan, points, thinned);
  geometry::turn_toward(scan.view.origin, points, normals);
  std::vector<std::uint8_t> bright(thinned.rows.size());
  for (std::size_t i = 0; i < bright.size(); ++i) {
    const float share = normals.row(static_cast<Eigen::Index>(i)).dot(light.transpose());
    bright[i] = static_cast<std::uint8_t>(
        std::isfinite(share) ? std::lround(255 * std::clamp(share, 0.0F, 1.0F)) : 0L);
  }
  return bright;
}

}  // namespace posevote::page
