// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/normals.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "graph/parallel.hpp"

namespace posevote {
namespace {

/// Weighted first and second moments of offsets from a query point.
struct Moments {
  double weight = 0;
  int count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& offset, double w) {
    ++count;
    weight += w;
    sum += w * offset;
    products.noalias() += (w * offset) * offset.transpose();
  }
};

/// Direction of least spread; zero where the points lie on a line or in one place.
Eigen::Vector3f plane_normal(const Moments& moments) {
  const Eigen::Vector3d mean = moments.sum / moments.weight;
  const Eigen::Matrix3d covariance = moments.products / moments.weight - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d spread = solver.eigenvalues();
  if (!(spread(1) > 1e-4 * spread(2)) || !(spread(2) > 0)) return Eigen::Vector3f::Zero();
  return solver.eigenvectors().col(0).cast<float>();
}

}  // namespace

PointMatrix face_normals(const PointMatrix& points, const FaceMatrix& faces) {
  // In double: the cross products of tiny triangles far from the origin would lose their direction.
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> sums(points.rows(), 3);
  sums.setZero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = points.row(faces(f, 0)).cast<double>();
    const Eigen::Vector3d b = points.row(faces(f, 1)).cast<double>();
    const Eigen::Vector3d c = points.row(faces(f, 2)).cast<double>();
    const Eigen::Vector3d twice_area = (b - a).cross(c - a);
    for (int corner = 0; corner < 3; ++corner) sums.row(faces(f, corner)) += twice_area.transpose();
  }
  for (Eigen::Index i = 0; i < sums.rows(); ++i)
    if (const double length = sums.row(i).norm(); length > 0) sums.row(i) /= length;
  PointMatrix normals = sums.cast<float>();
  normalise(normals);
  return normals;
}

PointMatrix plane_normals(const PointMatrix& points, const PointGrid& grid, float radius,
                          int min_neighbours) {
  PointMatrix normals = PointMatrix::Zero(points.rows(), 3);
  const double per_square = 1.0 / (static_cast<double>(radius) * radius);
  graph::parallel_for(static_cast<std::size_t>(points.rows()), 256, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::Vector3f center = points.row(row);
    Moments moments;
    grid.for_each_within(center, radius, [&](std::uint32_t index, float squared) {
      const Eigen::Vector3f offset = points.row(index).transpose() - center;
      moments.add(offset.cast<double>(), 1.0 - 0.999 * squared * per_square);
    });
    if (moments.count >= min_neighbours) normals.row(row) = plane_normal(moments);
  });
  normalise(normals);
  return normals;
}

void normalise(PointMatrix& normals) {
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const float length = normals.row(i).stableNorm();
    if (std::isfinite(length) && length > 1e-12F)
      normals.row(i) /= length;
    else
      normals.row(i).setZero();
  }
}

void turn_toward(const Eigen::Vector3f& viewpoint, const PointMatrix& points,
                 PointMatrix& normals) {
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (normals.row(i).dot(viewpoint.transpose() - points.row(i)) < 0) normals.row(i) *= -1.0F;
}

Cloud keep_oriented(const Cloud& cloud, const PointMatrix& normals) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (!normals.row(i).isZero()) kept.push_back(i);
  if (kept.empty())
    throw std::runtime_error("none of its " + std::to_string(cloud.points.rows()) +
                             " points has a usable normal");
  Cloud out;
  out.points = cloud.points(kept, Eigen::all);
  out.normals = normals(kept, Eigen::all);
  out.viewpoint = cloud.viewpoint;
  out.dropped = cloud.dropped + static_cast<std::size_t>(cloud.points.rows()) - kept.size();
  return out;
}

float point_spacing(const PointMatrix& points) {
  const Eigen::Vector3f extent =
      points.rows() == 0
          ? Eigen::Vector3f::Zero().eval()
          : Eigen::Vector3f(points.colwise().maxCoeff() - points.colwise().minCoeff());
  const float diagonal = extent.norm();
  if (!(diagonal > 0)) return 0;
  // A cell that would hold one point if they filled the largest side of the bounding box.
  const PointGrid grid(points, diagonal / std::sqrt(static_cast<float>(points.rows())));
  std::vector<float> distances;
  const Eigen::Index step = std::max<Eigen::Index>(1, points.rows() / 1000);
  for (Eigen::Index i = 0; i < points.rows(); i += step) {
    const Eigen::Vector3f center = points.row(i);
    float nearest = diagonal * diagonal;
    for (float radius = grid.cell(); nearest > radius * radius && radius < 2 * diagonal;
         radius *= 2)
      grid.for_each_within(center, radius, [&](std::uint32_t, float squared) {
        if (squared > 0) nearest = std::min(nearest, squared);
      });
    distances.push_back(std::sqrt(nearest));
  }
  std::nth_element(distances.begin(), distances.begin() + static_cast<long>(distances.size() / 2),
                   distances.end());
  return distances[distances.size() / 2];
}

}  // namespace posevote
