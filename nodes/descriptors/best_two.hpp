// SPDX-License-Identifier: BSD-3-Clause
// Which two rows are nearest: the one rule that all ways of searching share.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>

namespace posevote::descriptors {

/// The nearest and second nearest row of one query, nearer first; of equally near rows the smaller
/// comes first. Where there is only one row, it stands twice.
struct TwoNearest {
  std::uint32_t row[2] = {0, 0};
  float squared[2] = {0, 0};  ///< squared Euclidean distances
};

/// How little a match says, in [0, 1]: squared distance of the nearest over the second nearest; 0/0
/// is 1.
inline float squared_ratio(const TwoNearest& nearest) {
  const float ratio = nearest.squared[0] / nearest.squared[1];
  return ratio <= 1 ? ratio : 1;
}

/// The best two of the rows that were offered, in whatever order; each row once.
class BestTwo {
 public:
  void offer(double squared, std::uint32_t row) {
    if (closer(squared, row, 0)) {
      squared_[1] = std::exchange(squared_[0], squared);
      row_[1] = std::exchange(row_[0], row);
    } else if (closer(squared, row, 1)) {
      squared_[1] = squared;
      row_[1] = row;
    }
  }
  /// Squared distance of the second best; infinity as long as there is none.
  double second_squared() const { return squared_[1]; }

  TwoNearest result() const {
    const int second = row_[1] != kNone ? 1 : 0;
    return {{row_[0], row_[second]},
            {static_cast<float>(squared_[0]), static_cast<float>(squared_[second])}};
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  bool closer(double squared, std::uint32_t row, int than) const {
    return squared < squared_[than] || (squared == squared_[than] && row < row_[than]);
  }

  double squared_[2] = {kFar, kFar};
  std::uint32_t row_[2] = {kNone, kNone};
};

}  // namespace posevote::descriptors
