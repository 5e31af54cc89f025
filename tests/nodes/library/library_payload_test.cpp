// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/library_payload.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <optional>
#include <random>

#include "tests/nodes/match/small_library.hpp"

namespace posevote::library_payload_test {

using namespace posevote::test;

namespace {

ModelLibrary example(const std::string& search = "exact") {
  return make_library({{0, 10, 11}, {100}, {20, 30}}, {{"search", search}}, {3, 1, 9});
}

std::optional<ModelLibrary> decode_or_refuse(const std::string& payload) {
  try {
    return library::decode_library(payload);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace

TEST_CASE("the payload is checked by itself: a checksum proves nothing", "[match]") {
  for (const std::string search : {"exact", "kd_tree", "approximate"}) {
    INFO(search);
    const std::string good = library::encode_library(example(search));
    // A file can hold anything under a right checksum; none of these may crash or allocate wildly.
    for (std::size_t i = 0; i < good.size(); ++i)
      for (const char value : {'\0', '\x7F', '\xFF'}) {
        std::string bad = good;
        bad[i] = value;
        decode_or_refuse(bad);
        if (i + 8 > good.size()) continue;
        std::fill_n(bad.begin() + static_cast<std::ptrdiff_t>(i), 8, value);
        decode_or_refuse(bad);
      }
    CHECK_THROWS_WITH(library::decode_library(good + "x"), Catch::Contains("damaged"));
    CHECK_NOTHROW(library::decode_library(good));
  }
}

TEST_CASE("whatever a payload holds, what is decoded from it is sound", "[match]") {
  const std::string good = library::encode_library(example());
  std::mt19937 random(11);
  int decoded = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string bad = good;
    for (unsigned flips = 1 + random() % 4; flips > 0; --flips)
      bad[random() % bad.size()] ^= static_cast<char>(1U << (random() % 8));
    if (random() % 8 == 0) bad.resize(random() % bad.size());
    if (const auto library = decode_or_refuse(bad)) {
      ++decoded;
      CHECK(library::encode_library(*library) ==
            bad);  // nothing was read otherwise than it was written
    }
  }
  CHECK(decoded > 0);  // a name, a descriptor or a hundredth of a millimetre may be anything
  CHECK(decoded < 3600);
}

}  // namespace posevote::library_payload_test
