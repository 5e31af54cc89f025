// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/pair_table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <limits>
#include <vector>

#include "nodes/pairs/pair_key.hpp"
#include "tests/support/instruction_set.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::pair_table_test {
namespace {

Cloud ball(int count) {
  const PointMatrix points = test::sphere(count, 0.05F);
  return {points, points / 0.05F, {}};
}

}  // namespace

TEST_CASE("every pair of a model's points is in its bin, from both ends", "[pairs]") {
  const pairs::PairTable table(ball(60), 0.002F, 0.1F);  // so fine that no two points are one
  REQUIRE(table.points().size() == 60);
  std::size_t all = 0;
  for (std::uint32_t bin = 0; bin < table.bins(); ++bin)
    for (const pairs::PairEnd end : table[bin]) {
      ++all;
      const pairs::LocalFrame& from = table.points()[end.point];
      bool found = false;
      for (const pairs::LocalFrame& to : table.points()) {
        const Eigen::Vector3f offset = to.point - from.point;
        if (pairs::pair_bin(from.normal, to.normal, offset, 0.002F) == bin &&
            from.turn_to(offset) == end.turn)
          found = true;
      }
      CHECK(found);
    }
  CHECK(all == 60 * 59);
}

TEST_CASE("of a bin, those with about one turn are counted around the circle", "[pairs]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  for (const float step : {0.002F, 0.02F}) {  // few ends a bin; many, which are searched
    const pairs::PairTable table(ball(step < 0.01F ? 20 : 60), step, 0.1F);
    std::size_t found = 0, largest = 0;
    for (std::uint32_t bin = 0; bin < table.bins(); ++bin)
      for (const int turn : {0, 5, 100, 250, 255}) {
        std::vector<std::uint16_t> expected(table.points().size(), 0), counts = expected;
        for (const pairs::PairEnd end : table[bin]) {
          const int off = std::abs(turn - end.turn);
          if (std::min(off, 256 - off) <= 14) ++expected[end.point], ++found;
        }
        std::vector<pairs::TurnedRun> runs;
        table.add_turned(bin, turn, 14, runs);
        pairs::count_turned(table.ends(), runs.data(), runs.size(), 28, counts.data());
        CHECK(counts == expected);
        largest = std::max(largest, table[bin].size());
      }
    CHECK(found > 100);
    CHECK((largest > 64) == (step > 0.01F));
  }
}

TEST_CASE("of a bin, all turns are counted, by how far the scan's is ahead", "[pairs]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  const pairs::PairTable table(ball(60), 0.02F, 0.1F);
  std::vector<std::uint16_t> expected(table.points().size() * pairs::kTurns, 0), counts = expected;
  std::vector<pairs::TurnedRun> runs;
  for (std::uint32_t bin = 0; bin < table.bins(); ++bin)
    for (const int turn : {0, 5, 100, 250}) {
      table.add_all(bin, static_cast<std::uint8_t>(turn), runs);
      for (const pairs::PairEnd end : table[bin])
        ++expected[end.point * pairs::kTurns +
                   static_cast<std::size_t>((turn - end.turn) & 255) / 8];
    }
  pairs::count_turns(table.ends(), runs.data(), runs.size(), counts.data());
  CHECK(counts == expected);
}

TEST_CASE("a table is of a thinned model", "[pairs]") {
  const pairs::PairTable table(ball(5000), 0.02F, 0.1F);
  CHECK(table.points().size() > 60);
  CHECK(table.points().size() < 250);
  CHECK(table.step() == 0.02F);
  CHECK(table.reach() == 0.1F);
}

TEST_CASE("steps that fit no model are refused", "[pairs]") {
  for (const float step : {0.0F, 0.0001F, 0.2F, -1.0F, std::numeric_limits<float>::quiet_NaN()})
    CHECK_THROWS_WITH(pairs::PairTable(ball(60), step, 0.1F), Catch::Contains("step of pairs"));
  CHECK_THROWS_AS(pairs::PairTable(ball(60), 0.01F, std::numeric_limits<float>::quiet_NaN()),
                  std::runtime_error);
}

}  // namespace posevote::pair_table_test
