// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/pair_key.hpp"

#include <catch2/catch.hpp>

namespace posevote::pair_key_test {

using namespace posevote::pairs;

namespace {

constexpr float kStep = 0.01F;

/// The bins of a pair by its length in steps and its angles.
std::uint32_t bin(std::uint32_t length, std::uint32_t from, std::uint32_t to,
                  std::uint32_t between) {
  return ((length * 15 + from) * 15 + to) * 15 + between;
}

Eigen::Vector3f tilted(float degrees) {
  const float angle = degrees * static_cast<float>(M_PI) / 180;
  return {std::sin(angle), 0, std::cos(angle)};
}

}  // namespace

TEST_CASE("a pair's bin tells its length and its three angles", "[pairs]") {
  // From z to a normal 66 deg off, 2.5 steps along x: 90, 24 and 66 deg.
  CHECK(pair_bin(tilted(0), tilted(66), {0.025F, 0, 0}, kStep) == bin(2, 7, 2, 5));
  CHECK(pair_bin(tilted(0), tilted(-66), {0.025F, 0, 0}, kStep) == bin(2, 7, 13, 5));
  CHECK(pair_bin(tilted(0), tilted(180), {0, 0, -0.125F}, kStep) == bin(12, 14, 0, 14));
}

TEST_CASE("pairs in a plane and pairs too near have no bin", "[pairs]") {
  CHECK(pair_bin(tilted(0), tilted(0), {0.05F, 0, 0}, kStep) == kNoBin);
  CHECK(pair_bin(tilted(0), tilted(10), {0, 0.05F, 0}, kStep) == kNoBin);
  CHECK(pair_bin(tilted(0), tilted(0), {0.05F, 0, 0.02F}, kStep) != kNoBin);
  CHECK(pair_bin(tilted(0), tilted(66), {0.009F, 0, 0}, kStep) == kNoBin);
  CHECK(pair_bin(tilted(0), tilted(66), {0, 0, 0}, kStep) == kNoBin);
}

TEST_CASE("bins of angles are those of the arc cosine, but for rounding", "[pairs]") {
  int others = 0;
  for (int i = 0; i < 1800; ++i) {
    const double angle = (i + 0.5) * std::numbers::pi / 1800;
    const auto expected = static_cast<std::uint32_t>(angle * 15 / std::numbers::pi);
    others += angle_bin(angle_step(static_cast<float>(std::cos(angle)))) != expected ? 1 : 0;
  }
  CHECK(others < 15);
  CHECK(angle_bin(angle_step(1.0001F)) == 0);
  CHECK(angle_bin(angle_step(-1.0001F)) == 14);
}

}  // namespace posevote::pair_key_test
