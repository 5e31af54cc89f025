// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/data/splitmix64.hpp"

namespace posevote::geometry {

/// Some of many that lie in an order that runs through space: of so many that follow one another,
/// one, by a number that looks like chance and is always the same. Not each with the same number
/// among its neighbours: on a regular surface those would be alike, say in every second place the
/// points of one side of a box.
class Strewn {
 public:
  /// About `wanted` of `count`; all for 0.
  Strewn(Eigen::Index count, Eigen::Index wanted)
      : count_(count), stride_(wanted > 0 ? count / wanted + 1 : 1) {}

  std::size_t size() const { return static_cast<std::size_t>((count_ + stride_ - 1) / stride_); }
  /// So many each of them stands for.
  Eigen::Index stride() const { return stride_; }
  /// Which that is, k < size(); rising.
  Eigen::Index operator[](std::size_t k) const {
    const Eigen::Index first = static_cast<Eigen::Index>(k) * stride_;
    const auto choice = static_cast<std::uint64_t>(std::min(stride_, count_ - first));
    return first + static_cast<Eigen::Index>((splitmix64(k) >> 32U) * choice >> 32U);
  }
  /// All of those.
  std::vector<Eigen::Index> numbers() const {
    std::vector<Eigen::Index> all(size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = (*this)[k];
    return all;
  }

 private:
  Eigen::Index count_, stride_;
};

}  // namespace posevote::geometry
