// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/plane_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/data/splitmix64.hpp"
#include "nodes/geometry/spread.hpp"

namespace posevote::geometry {
namespace {

constexpr float kThickest = 0.2F;  ///< of the radius
constexpr float kWiden = 1.25F;
constexpr float kWidest = 4;  ///< x starting radius

Eigen::Matrix3d covariance_of(const PlaneMoments& sum) {
  Eigen::Matrix3d products;
  products << sum.xx, sum.xy, sum.xz, sum.xy, sum.yy, sum.yz, sum.xz, sum.yz, sum.zz;
  const auto weight = static_cast<double>(sum.one);
  const Eigen::Vector3d mean = Eigen::Vector3d(sum.x, sum.y, sum.z) / weight;
  return products / weight - mean * mean.transpose();
}

}  // namespace

Plane plane_of(const PlaneMoments& moments, float radius, int min_neighbours) {
  if (moments.count < static_cast<float>(min_neighbours)) return {};
  const Spread spread = spread_of(covariance_of(moments));
  const double length = spread.across.norm();
  if (!(length > 0) || !std::isfinite(length)) return {};
  return {(spread.across / length).cast<float>(),
          radius * static_cast<float>(std::sqrt(spread.least))};
}

std::vector<std::size_t> sample_of(std::size_t count) {
  const std::size_t step = std::max<std::size_t>(1, count / kSample);
  std::vector<std::size_t> sample;
  for (std::size_t i = 0; i < count; i += step)
    sample.push_back(std::min(i + splitmix64(i) % step, count - 1));
  return sample;
}

float upper_median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

float typical_thickness(std::size_t count, const std::function<Plane(std::size_t, int)>& fit) {
  constexpr int kFewest = 5;
  const std::vector<std::size_t> sample = sample_of(count);
  std::vector<Plane> planes(sample.size());
  graph::parallel_for(sample.size(), 16,
                      [&](std::size_t i) { planes[i] = fit(sample[i], kFewest); });
  std::vector<float> thickness;
  for (const Plane& plane : planes)
    if (!plane.normal.isZero()) thickness.push_back(plane.thickness);
  return upper_median(std::move(thickness));
}

float suitable_radius(float start, const std::function<float(float radius)>& thickness) {
  float radius = start;
  while (radius * kWiden <= kWidest * start && thickness(radius) > kThickest * radius)
    radius *= kWiden;
  return radius;
}

}  // namespace posevote::geometry
