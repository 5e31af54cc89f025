// SPDX-License-Identifier: BSD-3-Clause
// Exact two nearest neighbours by blocked matrix multiplication.
//
// |a - b|^2 = |a|^2 + |b|^2 - 2 ab: the products run at the processor's full speed, which at 100
// and more dimensions beats every tree. They round, so they only select candidates, by a bound on
// that rounding; the candidates' distances are computed anew in double. Cost: queries x rows x
// dimension.
#pragma once

#include <memory>
#include <vector>

#include "nodes/data/features.hpp"
#include "nodes/match/best_two.hpp"

namespace posevote {

/// Immutable once built. Descriptors must be finite; at least one.
class BruteForce {
 public:
  explicit BruteForce(const DescriptorMatrix& rows);
  ~BruteForce();

  /// Parallel over the queries; `queries` has as many columns as `rows` had, and is finite.
  std::vector<TwoNearest> nearest_two(const DescriptorMatrix& queries) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace posevote
