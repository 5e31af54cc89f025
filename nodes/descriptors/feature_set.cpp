// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/feature_set.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/geometry/rows_that.hpp"
#include "nodes/geometry/select_rows.hpp"

namespace posevote::descriptors {
namespace {

const Cloud& checked(const Cloud& cloud, const FeaturePoints& points, const Scale& scale) {
  require_describable(cloud, points, scale);
  return cloud;
}

/// Keeps those rows, in place: a large scan's take tens of megabytes.
void close_gaps(DescriptorMatrix& descriptors, const std::vector<std::uint32_t>& kept) {
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (kept[k] != k) descriptors.row(static_cast<Eigen::Index>(k)) = descriptors.row(kept[k]);
  descriptors.conservativeResize(static_cast<Eigen::Index>(kept.size()), Eigen::NoChange);
}

}  // namespace

void require_describable(const Cloud& cloud, const FeaturePoints& points, const Scale& scale) {
  if (cloud.normals.rows() != cloud.points.rows())
    throw std::runtime_error("the cloud has " + std::to_string(cloud.points.rows()) +
                             " points but " + std::to_string(cloud.normals.rows()) + " normals");
  for (const std::uint32_t point : points.indices)
    if (point >= cloud.points.rows())
      throw std::runtime_error("feature point " + std::to_string(point) + " of a cloud of " +
                               std::to_string(cloud.points.rows()) + " points");
  if (!(scale.resolution > 0))
    throw std::runtime_error("the resolution is " + std::to_string(scale.resolution) +
                             " m, expected more than 0");
}

bool is_oriented(const Cloud& cloud, std::uint32_t point) {
  return cloud.points.row(point).allFinite() &&
         std::abs(cloud.normals.row(point).squaredNorm() - 1) < 0.5F;
}

FeatureSet keep_described(const Cloud& cloud, const FeaturePoints& points,
                          DescriptorMatrix descriptors, const std::vector<char>& described) {
  constexpr std::size_t kGrain = 512;  // rows are long
  const auto is_described = [&](std::uint32_t i) {
    return described[i] != 0 && descriptors.row(i).allFinite();
  };
  const std::vector<std::uint32_t> kept =
      geometry::rows_that(described.size(), is_described, kGrain);
  close_gaps(descriptors, kept);
  std::vector<std::uint32_t> kept_points;
  for (const std::uint32_t i : kept) kept_points.push_back(points.indices[i]);
  Cloud at = geometry::select_rows(cloud, kept_points);
  return {std::move(at.points), std::move(at.normals), std::move(descriptors), {}, {}};
}

Support::Support(const Cloud& cloud, const FeaturePoints& points, const Scale& scale, double radius,
                 int step)
    : cloud_(checked(cloud, points, scale)),
      points_(points),
      resolution_(scale.resolution),
      radius_(static_cast<float>(radius) * scale.resolution),
      some_(step > 1 ? geometry::select_rows(cloud, Eigen::seq(0, cloud.points.rows() - 1, step))
                     : Cloud{}),
      grid_(neighbours().points, 0.5F * radius_) {}

FeatureSet Support::describe_each(
    int length, const std::function<bool(std::uint32_t point, float* descriptor)>& describe) const {
  const std::size_t count = points_.indices.size();
  DescriptorMatrix descriptors(static_cast<Eigen::Index>(count), length);
  std::vector<char> described(count, 0);
  graph::parallel_for(count, 32, [&](std::size_t i) {
    const std::uint32_t point = points_.indices[i];
    if (is_oriented(cloud_, point))
      described[i] = describe(point, descriptors.row(static_cast<Eigen::Index>(i)).data());
  });
  return keep_described(cloud_, points_, std::move(descriptors), described);
}

}  // namespace posevote::descriptors
