// SPDX-License-Identifier: BSD-3-Clause
// The kernel against the formulas of the paper, and the vector code against it, bit for bit.
#include "nodes/vote/kernel.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "nodes/vote/scan_votes.hpp"
#include "nodes/vote/sorted_votes.hpp"
#include "tests/support/instruction_set.hpp"
#include "tests/support/votes.hpp"

namespace posevote {
namespace {

constexpr float kDegree = static_cast<float>(std::numbers::pi / 180);

VotePoint vote(const Eigen::Vector3f& t, const Eigen::Quaternionf& q) {
  return {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
}

VotePoint negated(const VotePoint& v) { return {v.tx, v.ty, v.tz, -v.qw, -v.qx, -v.qy, -v.qz}; }

TEST_CASE("a vote weighs exactly 1 at itself, whatever the sign", "[vote]") {
  std::mt19937 random(1);
  for (const float sigma_r : {1 * kDegree, 22.5F * kDegree, 90 * kDegree})
    for (int i = 0; i < 1000; ++i) {
      const VotePoint v = vote(test::random_direction(random), test::random_rotation(random));
      const Kernel kernel = make_kernel({0.01F, sigma_r});
      REQUIRE(kernel_units(kernel, v, v) == 1U << 25U);
      REQUIRE(kernel_units(kernel, v, negated(v)) == 1U << 25U);
    }
}

TEST_CASE("the kernel follows the paper, is cut at both bandwidths, and is symmetric", "[vote]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> share(0, 1.2F);
  const float sigma_r = kDegree * GENERATE(1.0F, 22.5F, 60.0F, 90.0F);
  const Bandwidth bandwidth{0.01F, sigma_r};
  const Kernel kernel = make_kernel(bandwidth);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Quaternionf q = test::random_rotation(random);
    const float t_share = share(random), r_share = share(random);
    const Eigen::AngleAxisf turn(r_share * sigma_r, test::random_direction(random));
    const VotePoint a = vote(Eigen::Vector3f::Zero(), q);
    const VotePoint b =
        vote(0.01F * t_share * test::random_direction(random), (turn * q).normalized());
    const std::uint32_t units = kernel_units(kernel, a, b);
    REQUIRE(units == kernel_units(kernel, b, a));
    REQUIRE(units == kernel_units(kernel, negated(a), b));
    if (t_share > 1.0001F || r_share > 1.001F) REQUIRE(units == 0);
    const double expected =
        std::exp(-0.5 * static_cast<double>(t_share * t_share + r_share * r_share));
    // A turn of 1 deg is told from its neighbours to some 1e-5 of itself by float quaternions.
    if (t_share < 0.9999F && r_share < 0.999F)
      REQUIRE(units / 33554432.0 == Approx(expected).epsilon(sigma_r < 0.1F ? 1e-4 : 3e-6));
  }
}

TEST_CASE("scanning equals the kernel bit for bit, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(3);
  const Bandwidth bandwidth{0.01F, 22.5F * kDegree};
  const Kernel kernel = make_kernel(bandwidth);
  const VoteSet votes = test::clustered_votes(random, 6000, 1, 0, bandwidth);
  std::vector<std::vector<float>> columns;
  for (const auto* c :
       {&votes.tx, &votes.ty, &votes.tz, &votes.qw, &votes.qx, &votes.qy, &votes.qz}) {
    columns.push_back(*c);
    columns.back().resize(c->size() + kScanPadding);
  }
  const VoteColumns pointers{columns[0].data(), columns[1].data(), columns[2].data(),
                             columns[3].data(), columns[4].data(), columns[5].data(),
                             columns[6].data()};
  for (std::uint32_t i = 0; i < 300; ++i) {
    const std::uint32_t begin = i * 7, end = i == 299 ? 6000 : begin + i % 70;
    const ScanRange ranges[2] = {{begin, end, 1}, {begin, end, -1}};
    const auto at = [&](std::size_t v) { return vote_point(votes, v); };
    std::uint64_t expected = 0;
    std::vector<std::uint32_t> back(6000 + kScanPadding, 0), expected_back = back;
    for (std::uint32_t v = begin; v < end; ++v) {
      expected_back[v] = kernel_units(kernel, at(i), at(v));
      expected += expected_back[v];
    }
    REQUIRE(scan_votes(kernel, pointers, at(i), ranges, 2, nullptr) == expected);
    REQUIRE(scan_votes(kernel, pointers, at(i), ranges, 2, back.data()) == expected);
    REQUIRE(back == expected_back);
  }
  const ScanRange all{0, 6000, 1};
  CHECK(scan_votes(kernel, pointers, vote({0, 0, 0}, {1, 0, 0, 0}), &all, 0, nullptr) == 0);
}

}  // namespace
}  // namespace posevote
