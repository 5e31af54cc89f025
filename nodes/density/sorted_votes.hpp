// SPDX-License-Identifier: BSD-3-Clause
// Votes sorted by the cell of a sparse grid over translations, so that everything near a place lies
// in a few contiguous runs. The grid has no extent: coordinates of kilometres cost nothing.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/data/votes.hpp"
#include "nodes/density/kernel.hpp"
#include "nodes/density/vote_table.hpp"

namespace posevote::density {

/// A cell of the translation grid; cells are ordered by x, then y, then z.
struct TranslationCell {
  std::int32_t x = 0, y = 0, z = 0;
  auto operator<=>(const TranslationCell&) const = default;
};

/// Cells that lie side by side along z.
struct CellRow {
  TranslationCell first;
  std::int32_t last_z = 0;

  bool is_before(const TranslationCell& cell) const {
    return cell.x == first.x && cell.y == first.y && cell.z - 1 == last_z;
  }
};

/// Translations that are neighbours lie in cells that differ by at most 1 along each axis.
struct SortedVotes {
  Bandwidth bandwidth;
  VoteTable votes;                        ///< by cell, then roughly by rotation
  std::vector<std::uint32_t> numbers;     ///< of each in the VoteSet
  std::vector<TranslationCell> cells;     ///< occupied ones, ascending
  std::vector<std::uint32_t> cell_begin;  ///< per cell and one more: its first vote

  std::size_t size() const { return numbers.size(); }
};

/// The cell of a usable vote.
TranslationCell translation_cell(const VotePoint& vote, Bandwidth bandwidth);

/// Vote v of a set.
VotePoint vote_point(const VoteSet& votes, std::size_t v);

/// Sorts the usable votes of a set (see is_usable); the others are left out.
SortedVotes sort_votes(const VoteSet& votes, Bandwidth bandwidth);

/// The votes at these positions, ascending.
SortedVotes select_votes(const SortedVotes& all, const std::vector<std::uint32_t>& positions);

/// The positions of votes whose number n has has[n] != 0.
std::vector<std::uint32_t> positions_that(const SortedVotes& votes, const std::vector<char>& has);

/// Of those, the ones in cells in which `others` has any, or that are beside such.
std::vector<std::uint32_t> positions_near(const SortedVotes& votes, const SortedVotes& others,
                                          const std::vector<char>& has);

/// Finds the votes of a row of cells and of the cells around it. Fast when asked for rows in
/// ascending order, for then each row around is found beside its predecessor.
class CellSearch {
 public:
  explicit CellSearch(const SortedVotes& votes) : votes_(&votes) {}

  /// The votes there, ascending; without those of lower cells if `not_lower`.
  const std::vector<IndexRange>& around(const CellRow& cells, bool not_lower = false) &;

 private:
  const SortedVotes* votes_;
  std::size_t cursor_[9] = {};  ///< per row around: where the last search ended
  std::vector<IndexRange> ranges_;
};

}  // namespace posevote::density
