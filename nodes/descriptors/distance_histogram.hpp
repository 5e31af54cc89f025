// SPDX-License-Identifier: BSD-3-Clause
// What histograms over pairs of a feature point and its neighbours, by distance and something else,
// have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace posevote::descriptors {

/// The two bins that share a value, `position` counted in bins; at the ends they are the same.
struct Shares {
  int bin[2];
  float weight[2];

  Shares(float position, int bins) {
    const float lower = std::floor(position - 0.5F);
    const float upper_weight = position - 0.5F - lower;
    for (int i = 0; i < 2; ++i) bin[i] = std::clamp(static_cast<int>(lower) + i, 0, bins - 1);
    weight[0] = 1 - upper_weight;
    weight[1] = upper_weight;
  }
};

/// Writes the bins of distance `row` of `rows`, whose sum is `sum`, so that the Euclidean distance is
/// the Hellinger distance; returns where the next are to be written.
inline float* write_row(std::span<const float> bins, float sum, int row, int rows,
                        float* descriptor) {
  // An annulus of a plane holds points in proportion to its radius: so much its row may weigh.
  const float share = (static_cast<float>(row) + 0.5F) / static_cast<float>(rows);
  // One neighbour more than there is keeps a row that one hardly touches from counting in full.
  const float scale = share / (sum + 1);
  for (const float bin : bins) *descriptor++ = std::sqrt(bin * scale);
  return descriptor;
}

}  // namespace posevote::descriptors
