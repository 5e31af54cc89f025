// SPDX-License-Identifier: BSD-3-Clause
// What fits of planes share, wherever the neighbours come from: voxels or the pixels of an image.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/plane_moments.hpp"

namespace posevote::geometry {

struct Plane {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, sign arbitrary; 0: no plane
  float thickness = 0;  ///< root mean square distance from the plane [m]
};

/// The plane of what lies within `radius` [m]. None where fewer than `min_neighbours` points, or
/// points on a line, leave it open.
Plane plane_of(const PlaneMoments& moments, float radius, int min_neighbours);

/// At how many of many places something is measured, at least.
constexpr std::size_t kSample = 1000;

/// All numbers below `count`, or of many at least kSample and fewer than twice as many, spread
/// evenly but by chance, so that they follow no columns of an image.
std::vector<std::size_t> sample_of(std::size_t count);

/// The median, of an even number the upper of the two; 0 of nothing.
float upper_median(std::vector<float> values);

/// A normal distribution's standard deviation over the median of its amounts.
constexpr double kDeviationOfMedian = 1.4826;

/// The typical thickness of planes at some of many places [m], by fit(place, min_neighbours), which
/// several threads call.
float typical_thickness(std::size_t count,
                        const std::function<Plane(std::size_t place, int min_neighbours)>& fit);

/// A radius wide enough for the noise: from `start` up until the typical neighbourhood, which
/// thickness(radius) is to find out, is at most a fifth of its radius thick, or four times `start`.
float suitable_radius(float start, const std::function<float(float radius)>& thickness);

}  // namespace posevote::geometry
