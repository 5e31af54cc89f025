// SPDX-License-Identifier: BSD-3-Clause
// Stable sort by an unsigned key, for the hundred thousands of points that are sorted into cells:
// several times as fast as std::sort, because most keys differ in few bits. Parallel where there are
// many.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"

namespace posevote::geometry {

/// Bits that order as the number does; not for NaN.
inline std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value == 0 ? 0.0F : value);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000U;
}

/// A key for what 64 bits do not hold, as places of clouds with points far away.
__extension__ using LargeNumber = unsigned __int128;

/// Sorts in ascending key(item), an unsigned number; equals stay in their order. Least significant
/// digit first; digits that all keys share cost nothing.
template <class Item, class KeyOf>
void radix_sort(std::vector<Item>& items, const KeyOf& key) {
  if (items.empty()) return;
  using Key = decltype(key(items.front()));
  static_assert(static_cast<Key>(-1) > Key{0}, "unsigned");
  constexpr int kDigit = 11;  // bits
  constexpr std::size_t kMask = (1U << kDigit) - 1;
  const auto digit = [&key](const Item& item, unsigned shift) {
    return static_cast<std::size_t>(key(item) >> shift) & kMask;
  };
  // In pieces, side by side: which item goes where does not hang on how many there are.
  constexpr std::size_t kMany = 1U << 15;
  const std::size_t pieces = items.size() < kMany ? 1 : 8;
  const auto for_each_piece = [&](const auto& visit) {
    graph::parallel_for(pieces, 1, [&](std::size_t p) {
      const std::size_t begin = p * items.size() / pieces, end = (p + 1) * items.size() / pieces;
      visit(p, std::span<const Item>(items).subspan(begin, end - begin));
    });
  };
  std::vector<Key> differences(pieces, 0);
  for_each_piece([&](std::size_t p, std::span<const Item> piece) {
    Key differing = 0;
    for (const Item& item : piece) differing |= key(item) ^ key(items.front());
    differences[p] = differing;
  });
  Key differing = 0;
  for (const Key one : differences) differing |= one;
  std::vector<Item> sorted(differing == 0 ? 0 : items.size());
  std::vector<std::array<std::size_t, kMask + 1>> places(pieces);
  for (unsigned shift = 0; shift < 8 * sizeof(Key); shift += kDigit) {
    if ((static_cast<std::size_t>(differing >> shift) & kMask) == 0) continue;
    for_each_piece([&](std::size_t p, std::span<const Item> piece) {
      places[p].fill(0);
      for (const Item& item : piece) ++places[p][digit(item, shift)];
    });
    std::size_t sum = 0;
    for (std::size_t d = 0; d <= kMask; ++d)
      for (auto& place : places) place[d] = std::exchange(sum, sum + place[d]);
    for_each_piece([&](std::size_t p, std::span<const Item> piece) {
      for (const Item& item : piece) sorted[places[p][digit(item, shift)]++] = item;
    });
    items.swap(sorted);
  }
}

}  // namespace posevote::geometry
