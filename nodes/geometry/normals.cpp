// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/normals.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/rows_that.hpp"
#include "nodes/geometry/select_rows.hpp"

namespace posevote::geometry {

PointMatrix face_normals(const PointMatrix& points, const FaceMatrix& faces) {
  check_faces(points, faces);
  // In double: the cross products of tiny triangles far from the origin would lose their direction.
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> sums(points.rows(), 3);
  sums.setZero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = points.row(faces(f, 0)).cast<double>();
    const Eigen::Vector3d b = points.row(faces(f, 1)).cast<double>();
    const Eigen::Vector3d c = points.row(faces(f, 2)).cast<double>();
    const Eigen::Vector3d twice_area = (b - a).cross(c - a);
    if (!twice_area.allFinite()) continue;
    for (int corner = 0; corner < 3; ++corner) sums.row(faces(f, corner)) += twice_area.transpose();
  }
  for (Eigen::Index i = 0; i < sums.rows(); ++i)
    if (const double length = sums.row(i).norm(); length > 0) sums.row(i) /= length;
  return sums.cast<float>();
}

void normalise(PointMatrix& normals) {
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const double length = normals.row(i).cast<double>().norm();
    if (std::isfinite(length) && length > 1e-12)
      normals.row(i) = (normals.row(i).cast<double>() / length).cast<float>();
    else
      normals.row(i).setZero();
  }
}

void turn_toward(const Eigen::Vector3f& sensor, const PointMatrix& points, PointMatrix& normals) {
  graph::parallel_for(static_cast<std::size_t>(normals.rows()), 8192, [&](std::size_t row) {
    const auto i = static_cast<Eigen::Index>(row);
    if (normals.row(i).dot(sensor.transpose() - points.row(i)) < 0) normals.row(i) *= -1.0F;
  });
}

std::vector<std::uint32_t> oriented_rows(const PointMatrix& points, const PointMatrix& normals) {
  std::vector<std::uint32_t> rows =
      rows_that(static_cast<std::size_t>(normals.rows()), [&](std::uint32_t i) {
        return !normals.row(i).isZero() && normals.row(i).allFinite() && points.row(i).allFinite();
      });
  if (rows.empty())
    throw std::runtime_error("none of its " + std::to_string(points.rows()) +
                             " points has a usable normal");
  return rows;
}

Cloud keep_oriented(const PointMatrix& points, PointMatrix normals, const View& view,
                    const ColorMatrix& colors) {
  const std::vector<std::uint32_t> kept = oriented_rows(points, normals);
  if (std::ssize(kept) == points.rows()) return {points, std::move(normals), view, colors};
  return {rows_of(points, kept), rows_of(normals, kept), view, select_if_any(colors, kept)};
}

void require_normals(const Cloud& cloud) {
  if (cloud.normals.rows() != cloud.points.rows())
    throw std::runtime_error("its points have no normals: put a normals node before this one");
}

void check_faces(const PointMatrix& points, const FaceMatrix& faces) {
  if (faces.rows() == 0 || faces.maxCoeff() < points.rows()) return;
  throw std::runtime_error("a face refers to point " + std::to_string(faces.maxCoeff()) + " of " +
                           std::to_string(points.rows()) + " (counted from 0)");
}

}  // namespace posevote::geometry
