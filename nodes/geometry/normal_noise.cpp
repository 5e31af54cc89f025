// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/normal_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/rows_that.hpp"
#include "nodes/geometry/spread.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::geometry {
namespace {

using Cell = std::array<int, 3>;

struct CubeNormal {
  Cell cell;
  Eigen::Vector3f normal;
};
using Normals = std::vector<CubeNormal>;  // by cell, each once

constexpr std::size_t kFewestPoints = 8;  // of a cube
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

Normals normals_of_cubes(const PointMatrix& points, const std::vector<std::uint32_t>& rows,
                         const Eigen::Vector3f& viewpoint, float width) {
  Eigen::RowVector3f low = points.row(rows.front());
  for (const std::uint32_t i : rows) low = low.cwiseMin(points.row(i));
  const Voxels voxels = group_by_voxel(points, rows, width);
  std::vector<std::optional<CubeNormal>> found(voxels.size());
  graph::parallel_for(voxels.size(), 64, [&](std::size_t v) {
    const auto members = voxels[v];
    if (members.size() < kFewestPoints) return;
    const Moments moments = moments_of(points, members);
    const auto normal = normal_of(moments, viewpoint, static_cast<double>(width));
    const Eigen::Vector3i cell =
        ((moments.mean.cast<float>() - low.transpose()) / width).array().floor().cast<int>();
    if (normal) found[v] = {{cell.x(), cell.y(), cell.z()}, *normal};
  });
  Normals normals;
  for (const auto& one : found)
    if (one) normals.push_back(*one);
  // Where rounding gives two cubes one cell, the last counts.
  std::ranges::reverse(normals);
  std::ranges::stable_sort(normals, {}, &CubeNormal::cell);
  const auto twice = std::ranges::unique(normals, {}, &CubeNormal::cell);
  normals.erase(twice.begin(), twice.end());
  return normals;
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

}  // namespace

std::optional<float> normal_noise(const PointMatrix& points, const std::vector<std::uint32_t>& rows,
                                  const Eigen::Vector3f& viewpoint, float width) {
  if (rows.empty()) return std::nullopt;
  std::vector<float> tilts = tilts_of(normals_of_cubes(points, rows, viewpoint, width));
  if (tilts.size() < kFewestTilts) return std::nullopt;
  const auto quarter = tilts.begin() + static_cast<std::ptrdiff_t>(tilts.size() / 4);
  std::nth_element(tilts.begin(), quarter, tilts.end());
  return *quarter / kQuartile;
}

}  // namespace posevote::geometry
