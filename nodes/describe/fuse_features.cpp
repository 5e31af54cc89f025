// SPDX-License-Identifier: BSD-3-Clause
// Puts two descriptors of the same feature points side by side, so that matching may take, for each
// feature of the scene, the one that tells it best: the descriptor whose match has the smallest
// ratio of the squared distances to the nearest and the second nearest (Buch, Petersen, Krueger:
// Local shape feature fusion, SpringerPlus 2016). Descriptors keep their own metric: their numbers
// are never mixed (FeatureSet::blocks). More than two are fused by repeating the node. With a
// `weight` they are mixed: the two become one descriptor, as colours beside a shape, which neither
// tells alone.
//
// Features are the same where point and normal are, to the bit: both inputs must describe the same
// feature points. Kept are those that both describe, in the order of the first. Fails if there are
// none. Time: O(n log n).
//
//   fuse_features: {in: [features_a, features_b], out: features}
#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double weight = 0;
};

using Place = std::array<float, 6>;

Place place_of(const FeatureSet& features, Eigen::Index row) {
  Place place;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    place[static_cast<std::size_t>(axis)] = features.points(row, axis);
    place[static_cast<std::size_t>(axis) + 3] = features.normals(row, axis);
  }
  return place;
}

/// Rows of `a` and `b` that are the same feature; where a place is taken several times, in order.
std::vector<std::pair<Eigen::Index, Eigen::Index>> common_rows(const FeatureSet& a,
                                                               const FeatureSet& b) {
  std::multimap<Place, Eigen::Index> rows_of;
  for (Eigen::Index row = 0; row < b.points.rows(); ++row) rows_of.emplace(place_of(b, row), row);
  std::vector<std::pair<Eigen::Index, Eigen::Index>> common;
  for (Eigen::Index row = 0; row < a.points.rows(); ++row) {
    const auto found = rows_of.lower_bound(place_of(a, row));
    if (found == rows_of.end() || found->first != place_of(a, row)) continue;
    common.emplace_back(row, found->second);
    rows_of.erase(found);
  }
  return common;
}

void append_blocks(std::vector<std::uint32_t>& blocks, const FeatureSet& features) {
  if (features.blocks.empty())
    blocks.push_back(static_cast<std::uint32_t>(features.descriptors.cols()));
  blocks.insert(blocks.end(), features.blocks.begin(), features.blocks.end());
}

FeatureSet fuse_features(const FeatureSet& a, const FeatureSet& b, const Params& params) {
  const auto rows = common_rows(a, b);
  if (rows.empty())
    throw std::runtime_error("none of " + std::to_string(a.points.rows()) + " and " +
                             std::to_string(b.points.rows()) +
                             " features are the same, expected two descriptors of the same points");
  const auto count = static_cast<Eigen::Index>(rows.size());
  FeatureSet fused;
  fused.points.resize(count, 3);
  fused.normals.resize(count, 3);
  fused.descriptors.resize(count, a.descriptors.cols() + b.descriptors.cols());
  for (Eigen::Index row = 0; row < count; ++row) {
    const auto [in_a, in_b] = rows[static_cast<std::size_t>(row)];
    fused.points.row(row) = a.points.row(in_a);
    fused.normals.row(row) = a.normals.row(in_a);
    fused.descriptors.row(row) << a.descriptors.row(in_a), b.descriptors.row(in_b);
  }
  if (params.weight > 0) {
    if (!a.blocks.empty() || !b.blocks.empty())
      throw std::runtime_error("descriptors that are fused already cannot become one");
    fused.descriptors.rightCols(b.descriptors.cols()) *= static_cast<float>(params.weight);
    return fused;
  }
  append_blocks(fused.blocks, a);
  append_blocks(fused.blocks, b);
  return fused;
}

const auto registered =
    graph::register_node("fuse_features", fuse_features,
                         "Two descriptors of the same points, for matching to choose from.")
        .input("features_a")
        .input("features_b")
        .output("features")
        .param("weight", &Params::weight, "",
               "Of the second in one descriptor that both make up, as colours beside a shape; 0: "
               "two, of which matching takes the one that tells a point best.",
               graph::at_least(0));

}  // namespace
}  // namespace posevote::describe
