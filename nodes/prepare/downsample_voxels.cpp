// SPDX-License-Identifier: BSD-3-Clause
// One oriented point per occupied voxel: the centroid, the mean normal (paper, section 4) and, where
// the cloud has colours, the mean of their light.
//
// Where the normals of a voxel cancel (their mean is shorter than a half: both sides of a thin
// wall), that mean would be garbage: the points are split along the normals' main axis, and each
// side makes a point. Points without a usable normal are left out. Output along a curve through
// space (geometry/curve_order.hpp), whatever the order of the input. O(n log n). Fails where points have no normals at all, or where the cloud
// is far larger than the voxels.
//
//   downsample_voxels: {in: [cloud, scale], out: small_cloud, leaf_size: 1}
#include <Eigen/Eigenvalues>
#include <array>
#include <span>
#include <stdexcept>
#include <vector>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/curve_order.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/rows_that.hpp"
#include "nodes/geometry/select_rows.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::prepare {
namespace {

struct Params {
  double leaf_size = 1;
};

constexpr double kCancelled = 0.5;

/// Sums over points that make one output point.
struct Group {
  Eigen::RowVector3d points = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d normals = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d colors = Eigen::RowVector3d::Zero();
  double count = 0;

  /// Whether there are points whose normals have a mean.
  bool has_normal() const { return normals.norm() > 1e-6 * count; }

  void add(const Cloud& cloud, std::uint32_t i) {
    points += cloud.points.row(i).cast<double>();
    normals += cloud.normals.row(i).cast<double>();
    if (cloud.colors.rows() > 0) colors += cloud.colors.row(i).cast<double>();
    ++count;
  }
};

/// An output point.
struct Made {
  explicit Made(const Group& of)
      : point((of.points / of.count).cast<float>()),
        normal(of.normals.normalized().cast<float>()),
        color((of.colors / of.count).cast<float>()) {}
  Made() = default;

  Eigen::RowVector3f point, normal, color;
};

/// The axis that the normals run along, one way or the other.
Eigen::Vector3d main_axis(const Cloud& cloud, std::span<const std::uint32_t> members) {
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d normal = cloud.normals.row(i).transpose().cast<double>();
    products += normal * normal.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products);
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis(largest) < 0 ? Eigen::Vector3d(-axis) : axis;  // the solver's sign is arbitrary
}

/// One point for a voxel; two where its normals cancel. The second may be empty.
std::array<Group, 2> group(const Cloud& cloud, std::span<const std::uint32_t> members) {
  std::array<Group, 2> sides;
  for (const std::uint32_t i : members) sides[0].add(cloud, i);
  if (sides[0].normals.norm() >= kCancelled * sides[0].count) return sides;
  const Eigen::Vector3d axis = main_axis(cloud, members);
  sides = {};
  for (const std::uint32_t i : members)
    sides[cloud.normals.row(i).cast<double>().dot(axis) > 0 ? 0 : 1].add(cloud, i);
  return sides;
}

Cloud downsample_voxels(const Cloud& cloud, const Scale& scale, const Params& params) {
  geometry::require_normals(cloud);
  const std::vector<std::uint32_t> usable = geometry::oriented_rows(cloud.points, cloud.normals);
  const geometry::Voxels voxels = geometry::group_by_voxel(
      cloud.points, usable, static_cast<float>(params.leaf_size) * scale.resolution);
  const auto made = geometry::joined_ranges(voxels.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Made> points;
    for (std::size_t v = begin; v < end; ++v)
      for (const Group& side : group(cloud, voxels[v]))
        if (side.has_normal()) points.emplace_back(side);
    return points;
  });
  const auto count = static_cast<Eigen::Index>(made.size());
  const bool is_colored = cloud.colors.rows() > 0;
  Cloud out{PointMatrix(count, 3), PointMatrix(count, 3), cloud.view,
            ColorMatrix(is_colored ? count : 0, 3)};
  graph::parallel_for(made.size(), 2048, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    out.points.row(row) = made[i].point;
    out.normals.row(row) = made[i].normal;
    if (is_colored) out.colors.row(row) = made[i].color;
  });
  return geometry::select_rows(
      out, geometry::rows_along_curve(out.points,
                                      static_cast<float>(params.leaf_size) * scale.resolution));
}

const auto registered =
    graph::register_node("downsample_voxels", downsample_voxels,
                         "One oriented point per occupied voxel (centroid, mean normal).")
        .input("cloud")
        .input("scale")
        .output("cloud")
        .param("leaf_size", &Params::leaf_size, "x resolution", "Edge of a voxel.",
               graph::greater_than(0));

}  // namespace
}  // namespace posevote::prepare
