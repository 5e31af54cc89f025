// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/sensor_noise.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "graph/parallel.hpp"
#include "nodes/geometry/point_spacing.hpp"
#include "nodes/geometry/spread.hpp"
#include "nodes/geometry/strewn.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::geometry {
namespace {

constexpr float kWidth = 6;              // x spacing, at least
constexpr float kThin = 0.08F;           // x width: a patch no thicker than that has a plane
constexpr int kMostDoublings = 4;        // of the width
constexpr std::size_t kFewest = 12;      // points in a patch
constexpr Eigen::Index kPatches = 4000;  // enough for a median

std::optional<Patch> measure(const PointMatrix& points, std::span<const std::uint32_t> members,
                             const Eigen::Vector3f& viewpoint) {
  if (members.size() < kFewest) return std::nullopt;
  const auto count = static_cast<double>(members.size());
  const auto [mean, covariance] = moments_of(points, members);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(count * covariance,
                                                            Eigen::EigenvaluesOnly);
  const Eigen::Vector3d squares = axes.eigenvalues().cwiseMax(0);
  Patch patch;
  patch.range = (mean.cast<float>() - viewpoint).norm();
  patch.noise = static_cast<float>(std::sqrt(squares(0) / (count - 3)));  // a plane takes three
  // Points strewn evenly over a rectangle a x b spread by a / sqrt(12) and b / sqrt(12).
  const double area = 12 * std::sqrt(squares(1) * squares(2)) / count;
  patch.spacing = static_cast<float>(std::sqrt(area / count));
  return patch;
}

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// From patches of one width.
SensorNoise measure_patches(const PointMatrix& points, const Eigen::Vector3f& viewpoint,
                            float width) {
  const Voxels voxels = group_by_voxel(points, width);
  const Strewn some(static_cast<Eigen::Index>(voxels.size()), kPatches);
  std::vector<std::optional<Patch>> patches(some.size());
  graph::parallel_for(patches.size(), 64, [&](std::size_t i) {
    patches[i] = measure(points, voxels[static_cast<std::size_t>(some[i])], viewpoint);
  });
  SensorNoise found;
  std::vector<float> noises, spacings;
  for (const auto& patch : patches) {
    if (!patch || !(patch->range > 0)) continue;
    noises.push_back(patch->noise / (patch->range * patch->range));
    spacings.push_back(patch->spacing / patch->range);
    found.ranges.push_back(patch->range);
  }
  if (noises.empty()) return found;
  found.noise_per_square = median(noises);
  found.spacing_per_range = median(spacings);
  std::sort(found.ranges.begin(), found.ranges.end());
  found.median_range = found.ranges[found.ranges.size() / 2];
  return found;
}

}  // namespace

SensorNoise measure_noise(const PointMatrix& points, const Eigen::Vector3f& viewpoint) {
  const float spacing = point_spacing(points);
  if (!(spacing > 0) || !std::isfinite(spacing)) return {};
  SensorNoise found;
  float width = kWidth * spacing;
  for (int i = 0; i <= kMostDoublings; ++i, width *= 2) {
    found = measure_patches(points, viewpoint, width);
    if (!found.ranges.empty() && found.noise_at(found.median_range) < kThin * width) break;
  }
  return found;
}

}  // namespace posevote::geometry
