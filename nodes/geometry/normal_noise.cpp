// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/normal_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/radix_sort.hpp"
#include "nodes/geometry/rows_that.hpp"
#include "nodes/geometry/spread.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::geometry {
namespace {

using Cell = std::array<std::uint32_t, 3>;

struct CubeNormal {
  Cell cell;
  Eigen::Vector3f normal;
};
using Normals = std::vector<CubeNormal>;  // by cell

constexpr double kFewestPoints = 8;  // of a cube
constexpr std::size_t kFewestTilts = 20;
// A surface that fills its cube from edge to edge spreads by width / sqrt(12) either way.
constexpr double kFilled = 0.5 / 12;  // x width squared
// Tilts about two axes of standard deviation s have their lower quartile at s sqrt(2 ln(4 / 3));
// one normal against the mean of two others varies 1.5 times as much as one alone.
const float kQuartile = std::sqrt(2 * std::log(4.0F / 3)) * std::sqrt(1.5F);

/// The unit normal, towards the viewpoint, of points that fill their cube.
std::optional<Eigen::Vector3f> normal_of(const Moments& moments, const Eigen::Vector3f& viewpoint,
                                         double width) {
  const Spread spread = spread_of(moments.covariance);
  if (!(spread.second > kFilled * width * width)) return std::nullopt;
  const Eigen::Vector3f normal = spread.across.normalized().cast<float>();
  return normal.dot(moments.mean.cast<float>() - viewpoint) > 0 ? -normal : normal;
}

const Eigen::Vector3f* normal_at(const Normals& normals, const Cell& cell) {
  const auto at = std::ranges::lower_bound(normals, cell, {}, &CubeNormal::cell);
  return at != normals.end() && at->cell == cell ? &at->normal : nullptr;
}

/// Of one cube's normal against the mean of those before and behind it along each axis.
void add_tilts(const Normals& normals, const CubeNormal& of, std::vector<float>& tilts) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Cell before = of.cell, after = of.cell;
    --before[axis];
    ++after[axis];
    const Eigen::Vector3f* one = normal_at(normals, before);
    const Eigen::Vector3f* other = one ? normal_at(normals, after) : nullptr;
    if (!other) continue;
    const float along = of.normal.dot((*one + *other).normalized());
    tilts.push_back(std::acos(std::clamp(along, -1.0F, 1.0F)));
  }
}

std::vector<float> tilts_of(const Normals& normals) {
  constexpr std::size_t kGrain = 256;  // each asks for six others
  const auto of_range = [&](std::size_t begin, std::size_t end) {
    std::vector<float> tilts;
    for (std::size_t i = begin; i < end; ++i) add_tilts(normals, normals[i], tilts);
    return tilts;
  };
  return joined_ranges(normals.size(), of_range, kGrain);
}

/// The cell of a cube's members, as group_by_voxel counts them.
Cell cell_of(const Eigen::RowVector3f& point, const Eigen::RowVector3f& low, double width) {
  const Eigen::RowVector3d cell = (point.cast<double>() - low.cast<double>()) * (1 / width);
  return {static_cast<std::uint32_t>(cell.z()), static_cast<std::uint32_t>(cell.y()),
          static_cast<std::uint32_t>(cell.x())};
}

/// Of both together: the covariance about the common mean has what their means differ by, too.
Moments joined(const Moments& a, double count_a, const Moments& b, double count_b) {
  const double share = count_b / (count_a + count_b);
  const Eigen::Vector3d between = b.mean - a.mean;
  return {a.mean + share * between, (1 - share) * a.covariance + share * b.covariance +
                                        share * (1 - share) * between * between.transpose()};
}

}  // namespace

NoiseCubes::NoiseCubes(const PointMatrix& points, const std::vector<std::uint32_t>& rows,
                       float width)
    : width_(static_cast<double>(width)) {
  if (rows.empty()) return;
  const Eigen::RowVector3f low = box_around(points, rows).min().transpose();
  const Voxels voxels = group_by_voxel(points, rows, width);
  cubes_.resize(voxels.size());
  graph::parallel_for(voxels.size(), 64, [&](std::size_t v) {
    const auto members = voxels[v];
    cubes_[v] = {cell_of(points.row(members.front()), low, width_),
                 static_cast<double>(members.size()), moments_of(points, members)};
  });
}

void NoiseCubes::widen() {
  width_ *= 2;
  struct Member {
    LargeNumber cell;
    std::uint32_t index;
  };
  std::vector<Member> members;
  for (Cube& cube : cubes_) {
    for (std::uint32_t& along : cube.cell) along /= 2;
    const auto [z, y, x] = cube.cell;
    members.push_back({LargeNumber{z} << 64U | LargeNumber{y} << 32U | x,
                       static_cast<std::uint32_t>(members.size())});
  }
  radix_sort(members, [](const Member& one) { return one.cell; });
  std::vector<Cube> wider;
  for (const Member& member : members) {
    const Cube& cube = cubes_[member.index];
    if (wider.empty() || wider.back().cell != cube.cell) {
      wider.push_back(cube);
      continue;
    }
    Cube& into = wider.back();
    into.moments = joined(into.moments, into.count, cube.moments, cube.count);
    into.count += cube.count;
  }
  cubes_ = std::move(wider);
}

std::optional<float> NoiseCubes::tilt(const Eigen::Vector3f& viewpoint) const {
  const auto of_range = [&](std::size_t begin, std::size_t end) {
    Normals normals;
    for (std::size_t i = begin; i < end; ++i) {
      if (cubes_[i].count < kFewestPoints) continue;
      if (const auto normal = normal_of(cubes_[i].moments, viewpoint, width_))
        normals.push_back({cubes_[i].cell, *normal});
    }
    return normals;
  };
  std::vector<float> tilts = tilts_of(joined_ranges(cubes_.size(), of_range, 64));
  if (tilts.size() < kFewestTilts) return std::nullopt;
  const auto quarter = tilts.begin() + static_cast<std::ptrdiff_t>(tilts.size() / 4);
  std::nth_element(tilts.begin(), quarter, tilts.end());
  return *quarter / kQuartile;
}

}  // namespace posevote::geometry
