// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/octaves.hpp"

#include <stdexcept>
#include <string>

#include "graph/parallel.hpp"

namespace posevote::descriptors {
namespace {

/// Their sizes together, checked.
FeatureSet make_room(const std::vector<const FeatureSet*>& features) {
  FeatureSet all;
  Eigen::Index rows = 0, columns = 0;
  for (const FeatureSet* one : features) {
    if (one->points.rows() == 0) continue;
    if (rows > 0 && (one->descriptors.cols() != columns || one->blocks != all.blocks))
      throw std::runtime_error("descriptors of " + std::to_string(columns) + " and of " +
                               std::to_string(one->descriptors.cols()) +
                               " numbers cannot be matched alike");
    rows += one->points.rows();
    columns = one->descriptors.cols();
    all.blocks = one->blocks;
  }
  all.points.resize(rows, 3);
  all.normals.resize(rows, 3);
  all.descriptors.resize(rows, columns);
  return all;
}

}  // namespace

FeatureSet stack_octaves(const std::vector<const FeatureSet*>& features,
                         const std::vector<Scale>& scales) {
  if (features.size() != scales.size())
    throw std::runtime_error(std::to_string(features.size()) + " feature sets of " +
                             std::to_string(scales.size()) + " scales");
  FeatureSet all = make_room(features);
  Eigen::Index begin = 0;
  for (std::size_t k = 0; k < features.size(); ++k) {
    const Eigen::Index rows = features[k]->points.rows();
    if (rows == 0) continue;
    graph::parallel_ranges(static_cast<std::size_t>(rows), 1024,
                           [&](std::size_t first, std::size_t last) {
                             const auto from = static_cast<Eigen::Index>(first),
                                        count = static_cast<Eigen::Index>(last - first);
                             const auto copy = [&](const auto& one, auto& to) {
                               to.middleRows(begin + from, count) = one.middleRows(from, count);
                             };
                             copy(features[k]->points, all.points);
                             copy(features[k]->normals, all.normals);
                             copy(features[k]->descriptors, all.descriptors);
                           });
    all.octaves.push_back({scales[k].resolution, static_cast<std::uint32_t>(begin),
                           static_cast<std::uint32_t>(begin + rows)});
    begin += rows;
  }
  return all;
}

}  // namespace posevote::descriptors
