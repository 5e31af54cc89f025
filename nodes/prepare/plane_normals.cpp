// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/plane_normals.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"

namespace posevote {
namespace {

constexpr float kMergePerRadius = 1.0F / 5;
constexpr float kThickest = 0.2F;  ///< of the radius
constexpr float kWiden = 1.25F;
constexpr float kWidest = 4;  ///< x starting radius
constexpr std::size_t kSample = 1000;

/// Four floats in one register (GCC and Clang on any processor); Eigen's would go through memory.
using Float4 [[gnu::vector_size(16)]] = float;

/// Weighted moments of offsets from a query point, in units of the radius: the sum of w p p^T for
/// p = (dx, dy, dz, 1), column by column. Single precision does: offsets are at most 1.
struct Moments {
  int count = 0;
  Float4 x{}, y{}, z{}, one{};

  void add(float dx, float dy, float dz, float w) {
    ++count;
    const Float4 weighted = w * Float4{dx, dy, dz, 1};
    x += dx * weighted, y += dy * weighted, z += dz * weighted, one += weighted;
  }

  Eigen::Matrix3d covariance() const {
    const double weight = static_cast<double>(one[3]);
    Eigen::Matrix3d products;
    products << x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2];
    const Eigen::Vector3d mean = Eigen::Vector3d(one[0], one[1], one[2]) / weight;
    return products / weight - mean * mean.transpose();
  }
};

PointMatrix centroids_of(const Voxels& voxels, const PointMatrix& points) {
  PointMatrix centroids(static_cast<Eigen::Index>(voxels.size()), 3);
  for (std::size_t v = 0; v < voxels.size(); ++v)
    centroids.row(static_cast<Eigen::Index>(v)) = voxels.centroid(points, v).cast<float>();
  return centroids;
}

std::vector<float> sizes_of(const Voxels& voxels) {
  std::vector<float> sizes(voxels.size());
  for (std::size_t v = 0; v < sizes.size(); ++v) sizes[v] = static_cast<float>(voxels[v].size());
  return sizes;
}

/// Every n-th of `count` things, so that they are at most twice `kSample`.
std::size_t sample_step(std::size_t count) { return std::max<std::size_t>(1, count / kSample); }

/// The median; 0 of nothing.
float median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Diagonal of the box that leaves out a twentieth of the points at either end of each axis.
float middle_diagonal(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Vector3f extent;
  const std::size_t cut = points.size() / 20;
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(),
                   [axis](const Eigen::Vector3f& point) { return point(axis); });
    std::sort(values.begin(), values.end());
    extent(axis) = values[values.size() - 1 - cut] - values[cut];
  }
  return extent.stableNorm();
}

float typical_thickness(const PointMatrix& points, float radius) {
  constexpr int kFewest = 5;
  const PlaneFitter fitter(points, radius);
  std::vector<float> thickness;
  for (std::size_t v = 0; v < fitter.size(); v += sample_step(fitter.size()))
    if (const PlaneFitter::Plane plane = fitter.fit(v, kFewest); !plane.normal.isZero())
      thickness.push_back(plane.thickness);
  return median(std::move(thickness));
}

/// The finite points, each place once.
PointMatrix distinct(const PointMatrix& points) {
  std::vector<std::array<float, 3>> places;
  places.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (points.row(i).allFinite()) places.push_back({points(i, 0), points(i, 1), points(i, 2)});
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  PointMatrix once(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i)
    once.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector3f::Map(places[i].data());
  return once;
}

}  // namespace

PlaneFitter::PlaneFitter(const PointMatrix& points, float radius)
    : radius_(radius),
      voxels_(group_by_voxel(points, radius * kMergePerRadius)),
      centroids_(centroids_of(voxels_, points)),
      sizes_(sizes_of(voxels_)),
      grid_(centroids_, radius) {}

PlaneFitter::Plane PlaneFitter::fit(std::size_t voxel, int min_neighbours) const {
  Moments moments;
  const float per_radius = 1 / radius_;
  const Eigen::Vector3f center = centroids_.row(static_cast<Eigen::Index>(voxel));
  grid_.for_each_offset_within(
      center, radius_, [&](std::uint32_t index, float squared, float dx, float dy, float dz) {
        // A little is left at the rim: where all neighbours sit there, they still make a plane.
        const float weight = 1 - 0.999F * squared * per_radius * per_radius;
        moments.add(dx * per_radius, dy * per_radius, dz * per_radius, weight * sizes_[index]);
      });
  if (moments.count < min_neighbours) return {};
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(moments.covariance());
  const Eigen::Vector3d spread = solver.eigenvalues();
  if (!(spread(1) > 1e-4 * spread(2)) || !(spread(2) > 0)) return {};
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
  if (!(std::abs(normal.norm() - 1) < 0.01F)) return {};
  return {normal.normalized(), radius_ * static_cast<float>(std::sqrt(std::max(0.0, spread(0))))};
}

PointMatrix plane_normals(const PointMatrix& points, float radius, int min_neighbours) {
  PointMatrix normals = PointMatrix::Zero(points.rows(), 3);
  if (!(radius > 0)) return normals;
  const PlaneFitter fitter(points, radius);
  graph::parallel_for(fitter.size(), 256, [&](std::size_t voxel) {
    const Eigen::Vector3f normal = fitter.fit(voxel, min_neighbours).normal;
    for (const std::uint32_t point : fitter.members(voxel)) normals.row(point) = normal;
  });
  return normals;
}

float suitable_radius(const PointMatrix& points, float smallest, float spacings) {
  const float spacing = point_spacing(points);
  if (!(spacing > 0)) return 0;
  const float start = std::max(smallest, spacings * spacing);
  float radius = start;
  while (radius * kWiden <= kWidest * start &&
         typical_thickness(points, radius) > kThickest * radius)
    radius *= kWiden;
  return radius;
}

float point_spacing(const PointMatrix& points) {
  const PointMatrix places = distinct(points);
  const auto count = static_cast<std::size_t>(places.rows());
  std::vector<Eigen::Vector3f> chosen;
  for (std::size_t i = 0; i < count; i += sample_step(count))
    chosen.emplace_back(places.row(static_cast<Eigen::Index>(i)));
  if (chosen.size() < 2) return 0;
  // A cell that would hold one point if they filled the largest side of the box around most: far
  // outliers must not set it.
  const float diagonal = middle_diagonal(chosen);
  const float cell = diagonal / std::sqrt(static_cast<float>(count));
  const PointGrid grid(places, cell);
  std::vector<float> distances;
  for (const Eigen::Vector3f& point : chosen) {
    float nearest = std::numeric_limits<float>::infinity();
    for (float reach = cell; nearest > reach * reach && reach < 4 * diagonal; reach *= 2)
      grid.for_each_within(point, reach, [&nearest](std::uint32_t, float squared) {
        if (squared > 0) nearest = std::min(nearest, squared);
      });
    if (std::isfinite(nearest)) distances.push_back(std::sqrt(nearest));
  }
  return median(std::move(distances));
}

}  // namespace posevote
