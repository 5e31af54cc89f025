// SPDX-License-Identifier: BSD-3-Clause
// Exact two nearest neighbours.
//
// Short descriptors (principal_axes.hpp), whose distances are never larger than the true ones, are
// compared with all rows by blocked products, |a - b|^2 = |a|^2 + |b|^2 - 2 ab, of 16-bit steps at
// the processor's full speed; at the lengths of descriptors that beats every tree. Rows which that
// leaves as near as the second nearest known so far, within a bound on what steps and rounding lose,
// are compared in full. Cost: queries x rows x short length, and some forty full distances a query.
#pragma once

#include <memory>
#include <vector>

#include "nodes/data/features.hpp"
#include "nodes/descriptors/best_two.hpp"

namespace posevote::descriptors {

/// Immutable once built. Descriptors must be finite; at least one.
class ExactIndex {
 public:
  explicit ExactIndex(DescriptorMatrix rows);
  ~ExactIndex();

  /// Parallel over the queries; `queries` has as many columns as `rows` had, and is finite.
  std::vector<TwoNearest> nearest_two(const DescriptorRows& queries) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace posevote::descriptors
