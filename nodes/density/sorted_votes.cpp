// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/sorted_votes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/density/rotation_cells.hpp"
#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/radix_sort.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::density {
namespace {

/// A vote and the number of its cell, which counts along z, then y, then x.
template <class Number>
struct Member {
  Number cell;
  std::uint32_t vote;
};

struct CellRange {
  TranslationCell low, high;

  std::uint64_t count(std::int32_t TranslationCell::*axis) const {
    return static_cast<std::uint64_t>(std::int64_t{high.*axis} - low.*axis + 1);
  }
};

constexpr auto kAxes = {&TranslationCell::x, &TranslationCell::y, &TranslationCell::z};

/// The cells that usable votes, at least one, lie in.
CellRange range_of(const VoteSet& votes, const std::vector<std::uint32_t>& usable,
                   Bandwidth bandwidth) {
  const Eigen::AlignedBox3f box = geometry::box_around(usable.size(), [&](std::size_t i) {
    const std::uint32_t v = usable[i];
    return Eigen::Vector3f(votes.tx[v], votes.ty[v], votes.tz[v]);
  });
  const auto cell_of = [bandwidth](const Eigen::Vector3f& place) {
    return translation_cell({place.x(), place.y(), place.z(), 1, 0, 0, 0}, bandwidth);
  };
  return {cell_of(box.min()), cell_of(box.max())};
}

/// Brings the numbers of `sorted` into the order of their cells, those of one cell in that of their
/// rotations, and notes where each cell begins.
template <class Number>
void sort_by_cell(const VoteSet& votes, const std::vector<std::uint16_t>& orders,
                  const CellRange& range, SortedVotes& sorted) {
  const auto cell_of = [&](std::uint32_t vote) {
    return translation_cell(vote_point(votes, vote), sorted.bandwidth);
  };
  std::vector<Member<Number>> members(sorted.size());
  graph::parallel_for(members.size(), 4096, [&](std::size_t i) {
    const TranslationCell cell = cell_of(sorted.numbers[i]);
    Number number = 0;
    for (const auto axis : kAxes)
      number = number * static_cast<Number>(range.count(axis)) +
               static_cast<Number>(std::int64_t{cell.*axis} - range.low.*axis);
    members[i] = {number, sorted.numbers[i]};
  });
  geometry::radix_sort(
      members, [&orders](const Member<Number>& one) { return std::uint32_t{orders[one.vote]}; });
  geometry::radix_sort(members, [](const Member<Number>& one) { return one.cell; });
  sorted.cell_begin =
      geometry::joined_ranges(members.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> first;
        for (std::size_t i = begin; i < end; ++i) {
          sorted.numbers[i] = members[i].vote;
          if (i == 0 || members[i].cell != members[i - 1].cell)
            first.push_back(static_cast<std::uint32_t>(i));
        }
        return first;
      });
  sorted.cells.resize(sorted.cell_begin.size());
  graph::parallel_for(sorted.cells.size(), 4096, [&](std::size_t c) {
    sorted.cells[c] = cell_of(members[sorted.cell_begin[c]].vote);
  });
}

void sort_by_cell(const VoteSet& votes, const std::vector<std::uint16_t>& orders,
                  SortedVotes& sorted) {
  if (!sorted.numbers.empty()) {
    const CellRange range = range_of(votes, sorted.numbers, sorted.bandwidth);
    double count = 1;
    for (const auto axis : kAxes) count *= static_cast<double>(range.count(axis));
    if (count < 4e9)
      sort_by_cell<std::uint32_t>(votes, orders, range, sorted);
    else
      sort_by_cell<geometry::LargeNumber>(votes, orders, range, sorted);
  }
  sorted.cell_begin.push_back(static_cast<std::uint32_t>(sorted.size()));
}

std::vector<std::uint16_t> rotation_orders(const VoteSet& votes) {
  std::vector<std::uint16_t> orders(votes.tx.size());
  graph::parallel_ranges(orders.size(), 16384, [&](std::size_t begin, std::size_t end) {
    std::vector<RotationCode> codes(end - begin);
    encode_rotations({votes.qw.data() + begin, votes.qx.data() + begin, votes.qy.data() + begin,
                      votes.qz.data() + begin},
                     codes.size(), codes.data());
    for (std::size_t i = begin; i < end; ++i)
      orders[i] = static_cast<std::uint16_t>(rotation_order(codes[i - begin]));
  });
  return orders;
}

/// Copies the votes with these numbers.
void take(const std::array<const float*, kVoteColumns>& from,
          const std::vector<std::uint32_t>& numbers, VoteTable& to) {
  to.resize(numbers.size());
  for (std::size_t c = 0; c < kVoteColumns; ++c)
    graph::parallel_for(numbers.size(), 16384,
                        [column = to[c], source = from[c], &numbers](std::size_t i) {
                          column[i] = source[numbers[i]];
                        });
}

std::array<const float*, kVoteColumns> columns_of(const VoteColumns& columns) {
  std::array<const float*, kVoteColumns> each{};
  for (std::size_t c = 0; c < kVoteColumns; ++c) each[c] = columns[c];
  return each;
}

/// First position from `from` on, either way, whose cell is not less than `cell`; steps double.
std::size_t lower_bound_near(const std::vector<TranslationCell>& cells, const TranslationCell& cell,
                             std::size_t from) {
  if (from > 0 && cells[from - 1] >= cell) from = 0;
  std::size_t step = 1, low = from, high = from;
  while (high < cells.size() && cells[high] < cell) {
    low = high + 1;
    high = low + step;
    step *= 2;
  }
  const auto begin = cells.begin();
  const auto last = begin + static_cast<std::ptrdiff_t>(std::min(high, cells.size()));
  return static_cast<std::size_t>(
      std::lower_bound(begin + static_cast<std::ptrdiff_t>(low), last, cell) - begin);
}

}  // namespace

// Members have |x - x'| <= sigma_t (1 + 1e-6) (float rounding of the predicate). The cell is wider
// than that, and the rounding of the quotient, below 2^30 in size, is finer than the difference: so
// two members' quotients differ by less than 1, and their floors by at most 1.
TranslationCell translation_cell(const VotePoint& vote, Bandwidth bandwidth) {
  const double edge = static_cast<double>(bandwidth.sigma_t) * (1 + 1e-5);
  const auto floor_of = [edge](float x) {
    const double quotient = static_cast<double>(x) / edge;
    const auto whole = static_cast<std::int32_t>(quotient);  // std::floor is a call
    return whole - (quotient < whole ? 1 : 0);
  };
  return {floor_of(vote.tx), floor_of(vote.ty), floor_of(vote.tz)};
}

VotePoint vote_point(const VoteSet& votes, std::size_t v) {
  return {votes.tx[v], votes.ty[v], votes.tz[v], votes.qw[v],
          votes.qx[v], votes.qy[v], votes.qz[v]};
}

SortedVotes sort_votes(const VoteSet& votes, Bandwidth bandwidth) {
  const std::size_t count = votes.tx.size();
  SortedVotes sorted;
  sorted.bandwidth = bandwidth;
  sorted.numbers = geometry::rows_that(
      count, [&](std::uint32_t v) { return is_usable(vote_point(votes, v), bandwidth); });
  sort_by_cell(votes, rotation_orders(votes), sorted);
  take({votes.tx.data(), votes.ty.data(), votes.tz.data(), votes.qw.data(), votes.qx.data(),
        votes.qy.data(), votes.qz.data()},
       sorted.numbers, sorted.votes);
  return sorted;
}

SortedVotes select_votes(const SortedVotes& all, const std::vector<std::uint32_t>& positions) {
  SortedVotes selected;
  selected.bandwidth = all.bandwidth;
  for (std::size_t c = 0, first = 0; c < all.cells.size() && first < positions.size(); ++c) {
    const std::size_t begin = first;
    while (first < positions.size() && positions[first] < all.cell_begin[c + 1]) ++first;
    if (first == begin) continue;
    selected.cells.push_back(all.cells[c]);
    selected.cell_begin.push_back(static_cast<std::uint32_t>(begin));
  }
  selected.cell_begin.push_back(static_cast<std::uint32_t>(positions.size()));
  take(columns_of(all.votes.columns()), positions, selected.votes);
  selected.numbers.resize(positions.size());
  graph::parallel_for(positions.size(), 16384,
                      [&](std::size_t i) { selected.numbers[i] = all.numbers[positions[i]]; });
  return selected;
}

std::vector<std::uint32_t> positions_that(const SortedVotes& votes, const std::vector<char>& has) {
  return geometry::rows_that(votes.size(),
                             [&](std::uint32_t i) { return has[votes.numbers[i]] != 0; });
}

std::vector<std::uint32_t> positions_near(const SortedVotes& votes, const SortedVotes& others,
                                          const std::vector<char>& has) {
  std::vector<IndexRange> ranges;
  CellSearch search(votes);
  for (const TranslationCell& cell : others.cells)
    std::ranges::copy(search.around({cell, cell.z}), std::back_inserter(ranges));
  std::ranges::sort(ranges, {}, &IndexRange::begin);
  std::vector<std::uint32_t> positions;
  std::uint32_t done = 0;
  for (const IndexRange& range : ranges) {
    for (std::uint32_t i = std::max(done, range.begin); i < range.end; ++i)
      if (has[votes.numbers[i]] != 0) positions.push_back(i);
    done = std::max(done, range.end);
  }
  return positions;
}

const std::vector<IndexRange>& CellSearch::around(const CellRow& cells, bool not_lower) & {
  const TranslationCell& cell = cells.first;
  ranges_.clear();
  for (std::int32_t row = not_lower ? 4 : 0; row < 9; ++row) {
    TranslationCell wanted{cell.x + row / 3 - 1, cell.y + row % 3 - 1, cell.z - 1};
    if (not_lower && row == 4) wanted.z = cell.z;
    std::size_t& cursor = cursor_[row];
    cursor = lower_bound_near(votes_->cells, wanted, cursor);
    wanted.z = cells.last_z + 1;
    std::size_t last = cursor;
    while (last < votes_->cells.size() && votes_->cells[last] <= wanted) ++last;
    if (last > cursor) ranges_.push_back({votes_->cell_begin[cursor], votes_->cell_begin[last]});
  }
  return ranges_;
}

}  // namespace posevote::density
