// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/radix_sort.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

namespace posevote::radix_sort_test {
namespace {

template <class Key>
struct Item {
  Key key = 0;
  std::uint32_t place = 0;
  bool operator==(const Item&) const = default;
};

template <class Key>
std::vector<Item<Key>> random_items(std::size_t count, Key mask) {
  std::mt19937_64 random(3);
  std::vector<Item<Key>> items(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    geometry::LargeNumber key = random();
    key = key << 64 | random();
    items[i] = {static_cast<Key>(static_cast<Key>(key) & mask), i};
  }
  return items;
}

}  // namespace

TEMPLATE_TEST_CASE("radix_sort sorts as std::stable_sort does", "[prepare]", std::uint32_t,
                   std::uint64_t, geometry::LargeNumber) {
  constexpr unsigned kBits = 8 * sizeof(TestType);
  const TestType all = static_cast<TestType>(-1), one = 1;
  for (const TestType mask :
       {TestType{0}, TestType{7}, TestType{0x7FF}, TestType{0x400001}, all,
        static_cast<TestType>(all << (kBits / 2)), static_cast<TestType>(one << (kBits - 1) | one)})
    for (const std::size_t count : {0U, 1U, 5000U, 100000U}) {  // of so many, in pieces
      std::vector<Item<TestType>> items = random_items(count, mask), expected = items;
      geometry::radix_sort(items, [](const Item<TestType>& item) { return item.key; });
      std::stable_sort(
          expected.begin(), expected.end(),
          [](const Item<TestType>& a, const Item<TestType>& b) { return a.key < b.key; });
      CHECK((items == expected));
    }
}

TEST_CASE("ordered_bits order as floats do", "[prepare]") {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> ascending = {-kInfinity, -3e38F, -1,   -1e-40F, 0,
                                        1e-40F,     1e-3F,  1e3F, 3e38F,   kInfinity};
  for (std::size_t i = 1; i < ascending.size(); ++i)
    CHECK(geometry::ordered_bits(ascending[i - 1]) < geometry::ordered_bits(ascending[i]));
  CHECK(geometry::ordered_bits(-0.0F) == geometry::ordered_bits(0.0F));
}

}  // namespace posevote::radix_sort_test
