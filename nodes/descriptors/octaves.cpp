// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/octaves.hpp"

#include <stdexcept>
#include <string>

namespace posevote::descriptors {
namespace {

using Sets = std::vector<std::shared_ptr<const FeatureSet>>;

void require_alike(const FeatureSet& a, const FeatureSet& b) {
  if (a.descriptors.cols() != b.descriptors.cols() || a.blocks != b.blocks)
    throw std::runtime_error("descriptors of " + std::to_string(a.descriptors.cols()) + " and of " +
                             std::to_string(b.descriptors.cols()) +
                             " numbers cannot be matched alike");
}

/// The `rows` of all sets, one below the other.
PointMatrix stacked(const Sets& sets, PointMatrix FeatureSet::*rows) {
  Eigen::Index count = 0;
  for (const auto& set : sets) count += ((*set).*rows).rows();
  PointMatrix all(count, 3);
  Eigen::Index begin = 0;
  for (const auto& set : sets) {
    const PointMatrix& some = (*set).*rows;
    all.middleRows(begin, some.rows()) = some;
    begin += some.rows();
  }
  return all;
}

}  // namespace

FeatureSet stack_octaves(const Sets& features, const std::vector<Scale>& scales) {
  if (features.size() != scales.size())
    throw std::runtime_error(std::to_string(features.size()) + " feature sets of " +
                             std::to_string(scales.size()) + " scales");
  FeatureSet all;
  const FeatureSet* first = nullptr;
  std::uint32_t begin = 0;
  for (std::size_t k = 0; k < features.size(); ++k) {
    const auto rows = static_cast<std::uint32_t>(features[k]->points.rows());
    if (rows == 0) continue;
    if (first == nullptr) first = features[k].get();
    require_alike(*first, *features[k]);
    all.octaves.push_back(
        {scales[k].resolution, begin, begin + rows, {features[k], &features[k]->descriptors}});
    begin += rows;
  }
  all.points = stacked(features, &FeatureSet::points);
  all.normals = stacked(features, &FeatureSet::normals);
  if (first != nullptr) all.blocks = first->blocks;
  return all;
}

}  // namespace posevote::descriptors
