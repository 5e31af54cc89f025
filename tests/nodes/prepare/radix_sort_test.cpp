// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/radix_sort.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace posevote;

namespace {

struct Item {
  std::uint32_t key = 0, place = 0;
  bool operator==(const Item&) const = default;
};

std::vector<Item> random_items(std::size_t count, std::uint32_t mask) {
  std::mt19937 random(3);
  std::vector<Item> items(count);
  for (std::uint32_t i = 0; i < count; ++i)
    items[i] = {static_cast<std::uint32_t>(random()) & mask, i};
  return items;
}

}  // namespace

TEST_CASE("radix_sort sorts as std::stable_sort does", "[prepare]") {
  for (const std::uint32_t mask : {0U, 7U, 0x7FFU, 0xFFFF0000U, 0x400001U, 0xFFFFFFFFU})
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{5000}}) {
      std::vector<Item> items = random_items(count, mask), expected = items;
      radix_sort(items, [](const Item& item) { return item.key; });
      std::stable_sort(expected.begin(), expected.end(),
                       [](const Item& a, const Item& b) { return a.key < b.key; });
      CHECK(items == expected);
    }
}

TEST_CASE("ordered_bits order as floats do", "[prepare]") {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> ascending = {-kInfinity, -3e38F, -1,   -1e-40F, 0,
                                        1e-40F,     1e-3F,  1e3F, 3e38F,   kInfinity};
  for (std::size_t i = 1; i < ascending.size(); ++i)
    CHECK(ordered_bits(ascending[i - 1]) < ordered_bits(ascending[i]));
  CHECK(ordered_bits(-0.0F) == ordered_bits(0.0F));
}
