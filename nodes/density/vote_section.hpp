// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/density/rotation_cells.hpp"
#include "nodes/density/scan_votes.hpp"

namespace posevote::density {

/// Adds the blocks of a run of votes, each block once: runs come in ascending order.
void add_blocks(IndexRange votes, std::vector<IndexRange>& blocks);

/// Votes that lie one behind the other in a table: as they came, or sorted by rotation cell.
class VoteSection {
 public:
  explicit VoteSection(IndexRange votes = {}) : votes_(votes) {}

  IndexRange votes() const { return votes_; }
  std::uint32_t size() const { return votes_.end - votes_.begin; }
  bool is_sorted() const { return per_axis_ != 0; }

  /// By the codes of its votes. `places`: where each is to move to.
  void sort(const std::vector<RotationCode>& codes, std::uint32_t per_axis,
            std::vector<std::uint32_t>& places);

  /// Adds the blocks that hold the cells of a box, but for votes before `from`. It must be sorted.
  void add_rows(const RotationBox& box, std::uint32_t from, std::vector<IndexRange>& blocks) const;

 private:
  std::uint32_t coarse(std::uint32_t level) const { return (level * per_axis_) >> 8U; }
  std::uint32_t cell(std::uint32_t chart, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return ((chart * per_axis_ + a) * per_axis_ + b) * per_axis_ + c;
  }

  IndexRange votes_;
  std::uint32_t per_axis_ = 0;        ///< 0: not sorted
  std::vector<std::uint32_t> begin_;  ///< of the cells, and one more
};

}  // namespace posevote::density
