// SPDX-License-Identifier: BSD-3-Clause
// A body to describe, and how well its descriptors find their own place again.
#pragma once

#include <cmath>
#include <random>
#include <string>

#include "nodes/descriptors/descriptor_index.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::test {

inline FeaturePoints every(std::uint32_t step, const Cloud& cloud) {
  FeaturePoints points;
  for (std::uint32_t i = 0; i < cloud.points.rows(); i += step) points.indices.push_back(i);
  return points;
}

/// With colours that change over some ten grid widths, in each direction otherwise.
inline Cloud painted(Cloud cloud) {
  cloud.colors = (cloud.points / (3 * kResolution)).unaryExpr([](float at) {
    return 0.5F + 0.4F * std::sin(at);
  });
  return cloud;
}

inline Cloud moved(Cloud cloud, const Eigen::Affine3f& by) {
  cloud.points =
      (cloud.points * by.linear().transpose()).eval().rowwise() + by.translation().transpose();
  cloud.normals = (cloud.normals * by.linear().transpose()).eval();
  return cloud;
}

inline FeatureSet described(const std::string& node, const Cloud& cloud, std::uint32_t step,
                            const std::map<std::string, std::string>& params = {}) {
  return run_node<FeatureSet>(node, params, cloud, every(step, cloud), Scale{kResolution});
}

/// Share of the features of a noisy, differently sampled copy whose nearest descriptor on the body
/// lies within three grid widths.
inline double self_match_rate(const std::string& node, float noise,
                              const std::map<std::string, std::string>& params = {}) {
  Cloud copy = painted(bumpy_cloud(1, kResolution, 0.7));
  std::mt19937 random(5);
  for (float& value : copy.points.reshaped())
    value += noise * (static_cast<float>(random()) / 2147483648.0F - 1);
  const FeatureSet body = described(node, painted(bumpy_cloud(1, kResolution)), 2, params);
  const FeatureSet found = described(node, copy, 5, params);
  const auto nearest =
      descriptors::DescriptorIndex({body.descriptors}, {}).nearest_two(found.descriptors);
  double right = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i)
    right += (body.points.row(nearest[i].row[0]) - found.points.row(static_cast<Eigen::Index>(i)))
                 .norm() < 3 * kResolution;
  return right / static_cast<double>(nearest.size());
}

/// Distances of the rows of `a` to the same rows of `b`, relative, ascending.
inline std::vector<float> differences(const FeatureSet& a, const FeatureSet& b) {
  std::vector<float> difference;
  for (Eigen::Index i = 0; i < a.descriptors.rows(); ++i)
    difference.push_back((a.descriptors.row(i) - b.descriptors.row(i)).norm() /
                         a.descriptors.row(i).norm());
  std::sort(difference.begin(), difference.end());
  return difference;
}

/// The largest of them, leaving out the worst hundredth: a neighbour at exactly the radius may be in
/// for one and out for the other.
inline float typical_difference(const FeatureSet& a, const FeatureSet& b) {
  const std::vector<float> all = differences(a, b);
  return all[all.size() * 99 / 100];
}

}  // namespace posevote::test
