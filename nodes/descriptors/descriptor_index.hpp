// SPDX-License-Identifier: BSD-3-Clause
// The index that matching searches: the descriptors of all models, stacked.
//
//   exact        short descriptors on the processor's vector units (exact_index.hpp)
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
#include "nodes/descriptors/best_two.hpp"

namespace posevote::descriptors {

struct IndexOptions {
  std::string search = "exact";  ///< exact, kd_tree or approximate
  int trees = 4;                 ///< approximate: trees in the forest, 1 to 64
  int checks = 512;              ///< approximate: descriptors compared per query, at least 2
};

/// Numbers of columns of the descriptors that stand side by side in a row; empty: one descriptor.
using Blocks = std::vector<std::uint32_t>;

/// Immutable once built; safe to read from many threads. Of fused features, each block has an index
/// of its own.
class DescriptorIndex {
 public:
  /// Stacks the matrices in their order: row r of matrix i becomes row r + the rows of the matrices
  /// before. Throws std::runtime_error if there is no row, if the matrices differ in length, where
  /// a value is not finite, if the blocks are not the columns, or if an option is out of range.
  DescriptorIndex(const std::vector<DescriptorRows>& matrices, IndexOptions options,
                  Blocks blocks = {});
  ~DescriptorIndex();

  /// The two nearest rows of every query: by that block whose squared ratio is the smallest, of
  /// equal ones the first. Throws std::runtime_error if the queries are of another length than the
  /// rows, in other blocks, or where a value is not finite.
  std::vector<TwoNearest> nearest_two(const DescriptorRows& queries,
                                      const Blocks& blocks = {}) const;

  const IndexOptions& options() const;
  /// Whether the same descriptors always give the same matches.
  bool reproducible() const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// An index for each octave that any of these models has. Throws std::runtime_error where their
/// features are fused differently, or where there are none.
std::vector<LibraryOctave> index_octaves(const std::vector<std::shared_ptr<const Model>>& models,
                                         const IndexOptions& options);

}  // namespace posevote::descriptors
