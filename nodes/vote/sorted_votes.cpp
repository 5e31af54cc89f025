// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/vote/sorted_votes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "graph/parallel.hpp"

namespace posevote {
namespace {

constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// One stable pass of a radix sort: reorders `order` by the digit of its keys.
template <class DigitOf>
void sort_by_digit(std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& buffer,
                   const DigitOf& digit_of) {
  std::array<std::uint32_t, kDigits + 1> begin{};
  for (const std::uint32_t i : order) ++begin[digit_of(i) + 1];
  for (std::size_t d = 0; d < kDigits; ++d) begin[d + 1] += begin[d];
  for (const std::uint32_t i : order) buffer[begin[digit_of(i)]++] = i;
  order.swap(buffer);
}

/// Reorders `order` by one coordinate of the cells, in as many passes as its range needs.
void sort_by_axis(const std::vector<TranslationCell>& cells, std::int32_t TranslationCell::*axis,
                  std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& buffer) {
  if (order.empty()) return;
  std::int32_t low = cells[order[0]].*axis, high = low;
  for (const std::uint32_t i : order) {
    low = std::min(low, cells[i].*axis);
    high = std::max(high, cells[i].*axis);
  }
  const auto range = static_cast<std::uint32_t>(high) - static_cast<std::uint32_t>(low);
  for (unsigned shift = 0; shift < 32 && (range >> shift) != 0; shift += kDigitBits)
    sort_by_digit(order, buffer, [&, shift](std::uint32_t i) {
      const auto key = static_cast<std::uint32_t>(cells[i].*axis) - static_cast<std::uint32_t>(low);
      return (key >> shift) & (kDigits - 1);
    });
}

/// Appends a vote behind all others; opens its cell if that is new.
void append(SortedVotes& sorted, const TranslationCell& cell, const SortedVote& vote,
            std::uint32_t number) {
  if (sorted.cells.empty() || sorted.cells.back() != cell) {
    sorted.cells.push_back(cell);
    sorted.cell_begin.push_back(static_cast<std::uint32_t>(sorted.votes.size()));
  }
  sorted.votes.push_back(vote);
  sorted.numbers.push_back(number);
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
    return static_cast<std::int32_t>(std::floor(static_cast<double>(x) / edge));
  };
  return {floor_of(vote.tx), floor_of(vote.ty), floor_of(vote.tz)};
}

VotePoint vote_point(const VoteSet& votes, std::size_t v) {
  return {votes.tx[v], votes.ty[v], votes.tz[v], votes.qw[v],
          votes.qx[v], votes.qy[v], votes.qz[v]};
}

SortedVotes sort_votes(const VoteSet& votes, Bandwidth bandwidth) {
  const std::size_t count = votes.tx.size();
  std::vector<TranslationCell> cells(count);
  std::vector<SortedVote> encoded(count);
  std::vector<char> usable(count);
  graph::parallel_for(count, 4096, [&](std::size_t v) {
    encoded[v].point = vote_point(votes, v);
    usable[v] = is_usable(encoded[v].point, bandwidth);
    if (!usable[v]) return;
    cells[v] = translation_cell(encoded[v].point, bandwidth);
    encoded[v].code = encode_rotation(encoded[v].point);
  });
  std::vector<std::uint32_t> order;
  order.reserve(count);
  for (std::uint32_t v = 0; v < count; ++v)
    if (usable[v]) order.push_back(v);
  std::vector<std::uint32_t> buffer(order.size());
  for (const auto axis : {&TranslationCell::z, &TranslationCell::y, &TranslationCell::x})
    sort_by_axis(cells, axis, order, buffer);
  SortedVotes sorted;
  sorted.bandwidth = bandwidth;
  sorted.votes.reserve(order.size());
  sorted.numbers.reserve(order.size());
  for (const std::uint32_t v : order) append(sorted, cells[v], encoded[v], v);
  sorted.cell_begin.push_back(static_cast<std::uint32_t>(sorted.size()));
  return sorted;
}

SortedVotes select_votes(const SortedVotes& all, const std::vector<char>& keep) {
  SortedVotes selected;
  selected.bandwidth = all.bandwidth;
  for (std::size_t c = 0; c < all.cells.size(); ++c)
    for (std::uint32_t i = all.cell_begin[c]; i < all.cell_begin[c + 1]; ++i)
      if (keep[all.numbers[i]]) append(selected, all.cells[c], all.votes[i], all.numbers[i]);
  selected.cell_begin.push_back(static_cast<std::uint32_t>(selected.size()));
  return selected;
}

const std::vector<VoteRun>& CellSearch::around(const TranslationCell& cell) & {
  runs_.clear();
  for (std::int32_t row = 0; row < 9; ++row) {
    TranslationCell wanted{cell.x + row / 3 - 1, cell.y + row % 3 - 1, cell.z - 1};
    std::size_t& cursor = cursor_[row];
    cursor = lower_bound_near(votes_->cells, wanted, cursor);
    wanted.z = cell.z + 1;
    std::size_t last = cursor;
    while (last < votes_->cells.size() && votes_->cells[last] <= wanted) ++last;
    if (last > cursor) runs_.push_back({votes_->cell_begin[cursor], votes_->cell_begin[last]});
  }
  return runs_;
}

}  // namespace posevote
