// SPDX-License-Identifier: BSD-3-Clause
// The index that matching searches: the descriptors of all models, stacked.
//
//   exact        blocked brute force on the processor's vector units (brute_force.hpp)
//   kd_tree      FLANN's KDTreeSingleIndex; the same answer, slower at the lengths we use
//   approximate  FLANN's KDTreeIndex, a forest of randomised trees (the paper's choice). FLANN
//   shuffles
//                them by std::random_device, so matches differ from build to build, whatever the
//                seed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nodes/data/model.hpp"
#include "nodes/match/best_two.hpp"

namespace posevote {

struct IndexOptions {
  std::string search = "exact";  ///< exact, kd_tree or approximate
  int trees = 4;                 ///< approximate: trees in the forest
  int checks = 512;              ///< approximate: descriptors compared per query
};

/// Immutable once built; safe to read from many threads.
class DescriptorIndex {
 public:
  /// Stacks the blocks in their order: row r of block i becomes row r + the rows of the blocks
  /// before. Throws std::runtime_error if there is no row, if the blocks differ in length, or where
  /// a value is not finite.
  DescriptorIndex(const std::vector<const DescriptorMatrix*>& blocks, IndexOptions options);
  ~DescriptorIndex();

  /// The two nearest rows of every query. Throws std::runtime_error if the queries are of another
  /// length than the rows, or where a value is not finite.
  std::vector<TwoNearest> nearest_two(const DescriptorMatrix& queries) const;

  const IndexOptions& options() const;
  /// Whether the same descriptors always give the same matches.
  bool reproducible() const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// The index over the descriptors of these models, in their order.
std::shared_ptr<const DescriptorIndex> index_of(
    const std::vector<std::shared_ptr<const Model>>& models, const IndexOptions& options);

}  // namespace posevote
