// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/describe/feature_set.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace posevote {

void require_describable(const Cloud& cloud, const FeaturePoints& points, const Scale& scale) {
  if (cloud.normals.rows() != cloud.points.rows())
    throw std::runtime_error("the cloud has " + std::to_string(cloud.points.rows()) +
                             " points but " + std::to_string(cloud.normals.rows()) + " normals");
  if (points.indices.empty()) throw std::runtime_error("there are no feature points to describe");
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
                          const DescriptorMatrix& descriptors, const std::vector<char>& described) {
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < described.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (described[i] && descriptors.row(row).allFinite()) kept.push_back(row);
  }
  if (kept.empty())
    throw std::runtime_error("none of " + std::to_string(points.indices.size()) +
                             " feature points has enough neighbours and a normal to be described");
  const auto count = static_cast<Eigen::Index>(kept.size());
  FeatureSet features;
  features.points.resize(count, 3);
  features.normals.resize(count, 3);
  features.descriptors.resize(count, descriptors.cols());
  for (Eigen::Index row = 0; row < count; ++row) {
    const Eigen::Index from = kept[static_cast<std::size_t>(row)];
    const std::uint32_t point = points.indices[static_cast<std::size_t>(from)];
    features.points.row(row) = cloud.points.row(point);
    features.normals.row(row) = cloud.normals.row(point);
    features.descriptors.row(row) = descriptors.row(from);
  }
  return features;
}

}  // namespace posevote
